// Streams that no encoder writes: layers of arbitrary bytes or of random decisions, in a valid
// order and with correct checksums.
#pragma once

#include <random>

#include "allocation.h"
#include "coding/codec_state.h"
#include "stream_layout.h"
#include "unit/traversal.h"

namespace isostar {

inline Bytes noiseOf(std::size_t length, uint64_t seed) {
  std::mt19937_64 random(seed);
  Bytes bytes(length);
  for (auto& b : bytes) b = static_cast<std::byte>(random());
  return bytes;
}

template <int D>
Bytes fieldsOf(const GeometryPass<D>& pass) {
  Bytes bytes;
  ByteWriter out(bytes);
  pass.write(out);
  return bytes;
}

/// The base, all refinement levels, the domain, `passes`; for each further isovalue its signs and
/// the passes `further`. payload(code) returns the bytes of a layer after its fields.
template <int D, class Payload>
Bytes forgedStream(const Header& header, const std::vector<GeometryPass<D>>& passes,
                   const std::vector<GeometryPass<D>>& further, Payload payload) {
  Layers layers;
  CodecState<D> known(header);
  const auto add = [&](LayerKind kind, int level, Bytes bytes, auto code) {
    const Bytes coded = payload(code);
    bytes.insert(bytes.end(), coded.begin(), coded.end());
    layers.push_back({{kind, level, 0.1, 0, 0}, bytes});
  };
  add(LayerKind::Base, 0, {}, [&](auto& exchange) { known.base(exchange); });
  for (int level = 1; level <= header.finestLevel(); ++level)
    add(LayerKind::Refinement, level, {}, [&](auto& exchange) { known.refine(exchange); });
  if (header.trimmed)
    add(LayerKind::Domain, header.finestLevel(), {},
        [&](auto& exchange) { known.codeDomain(exchange); });
  for (const auto& pass : passes)
    add(pass.kind, header.finestLevel(), fieldsOf<D>(pass),
        [&](auto& exchange) { known.geometry(exchange, pass); });
  for (int number = 1; number <= static_cast<int>(header.furtherIsovalues.size()); ++number) {
    add(LayerKind::FurtherSigns, number, {},
        [&](auto& exchange) { known.furtherSigns(exchange, number); });
    for (const auto& pass : further) {
      Bytes bytes = fieldsOf<D>(pass);
      bytes.insert(bytes.begin(), static_cast<std::byte>(pass.kind));
      add(LayerKind::FurtherGeometry, number, bytes,
          [&](auto& exchange) { known.furtherGeometry(exchange, pass); });
    }
  }
  return assembled(header, layers);
}

/// What a decoder of volumes holds beside the memory that it counts and its input: its models.
inline constexpr std::size_t kModels = 9u << 18;

/// The peak of memory while all layers are decoded and both surfaces are made after each.
inline std::size_t peakOf(const Bytes& bytes, const Limits& limits, Error& error) {
  const Allocation allocation;
  Decoder decoder(limits);
  decoder.accept(bytes);
  decoder.finish();
  while (decoder.advance()) {
    Mesh mesh;
    Contours contours;
    for (const Polygonizer polygonizer : kPolygonizers) {
      (void)decoder.mesh({polygonizer}, mesh);
      (void)decoder.contours({polygonizer}, contours);
    }
  }
  error = decoder.error();
  return allocation.peak();
}

}  // namespace isostar
