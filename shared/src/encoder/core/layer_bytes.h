// Writes the layers of a stream, with their heads.
#pragma once

#include "coding/exchange/exchange.h"
#include "coding/geometry/geometry_pass.h"
#include "container/stream.h"

namespace isostar {

/// Used by the writers of uniform and of adaptive streams.
class LayerBytes {
 public:
  /// Appends a layer: the fields of the pass, if the kind has one, then what code(exchange) codes.
  /// error() is called afterwards; it must return the RMS distance of what a decoder then shows.
  template <int D, class Field, class Code, class Error>
  void add(LayerHead head, const GeometryPass<D>& pass, const Signs<D>& actual, const Field& field,
           Code code, Error error) {
    std::vector<std::byte> layer;
    if (traitsOf(head.kind).hasPass) {
      ByteWriter fields(layer);
      if (head.kind == LayerKind::FurtherGeometry) fields.u8(static_cast<uint64_t>(pass.kind));
      pass.write(fields);
    }
    RangeEncoder coder(layer);
    EncoderExchange<D, RangeEncoder, Field> exchange(coder, actual, field);
    code(exchange);
    coder.finish();
    head.error = error();
    append(bytes_, head, layer, layers_++);
  }

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t layers_ = 0;
};

}  // namespace isostar
