// The layers of a stream that is being written.
#pragma once

#include "coding/exchange/exchange.h"
#include "coding/geometry/geometry_pass.h"
#include "container/index.h"

namespace isostar {

/// A section: the fields of the pass, if the kind has one, then what code(exchange) codes.
/// `actual`: the signs of the level, or of the chunk.
template <int D, class Field, class Code>
std::vector<std::byte> codedSection(LayerKind kind, const GeometryPass<D>& pass,
                                    const Signs<D>& actual, const Field& field, Code code) {
  std::vector<std::byte> section;
  if (traitsOf(kind).hasPass) {
    ByteWriter fields(section);
    if (kind == LayerKind::FurtherGeometry) fields.u8(static_cast<uint64_t>(pass.kind));
    pass.write(fields);
  }
  RangeEncoder coder(section);
  EncoderExchange<D, RangeEncoder, Field> exchange(coder, actual, field);
  code(exchange);
  coder.finish();
  return section;
}

/// Used by the writers of uniform and of adaptive streams.
class CodedLayers {
 public:
  void add(LayerHead head, LayerSections sections) {
    heads_.push_back(std::move(head));
    layers_.push_back(std::move(sections));
  }

  /// Of all sections, with a head for each.
  [[nodiscard]] uint64_t bytes() const { return withHeads().size(); }
  /// Appends the stream.
  void write(Header header, std::vector<std::byte>& out) const {
    if (header.chunkSide != 0) {
      append(out, header, heads_, layers_);
      return;
    }
    const std::vector<std::byte> bytes = withHeads();
    header.bytes = bytes.size();
    ByteWriter writer(out);
    isostar::write(writer, header);
    out.insert(out.end(), bytes.begin(), bytes.end());
  }

 private:
  [[nodiscard]] std::vector<std::byte> withHeads() const {
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      for (const auto& section : layers_[i]) append(bytes, heads_[i], section, i);
    }
    return bytes;
  }

  std::vector<LayerHead> heads_;
  std::vector<LayerSections> layers_;
};

}  // namespace isostar
