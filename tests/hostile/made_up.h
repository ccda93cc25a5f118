// Streams that no encoder writes: layers of any bytes, or of answers thrown by dice, in a right order and behind right checksums.
#pragma once

#include <random>

#include "allocation.h"
#include "anatomy.h"
#include "coding/codec_state.h"
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

/// A base, all octaves, where the domain ends, the passes; of each further isovalue its signs and the passes `further`.
/// `payload(tell)` makes what stands behind a layer's fields.
template <int D, class Payload>
Bytes madeUp(const Header& header, const std::vector<GeometryPass<D>>& passes, const std::vector<GeometryPass<D>>& further, Payload payload) {
  std::vector<std::pair<LayerHead, Bytes>> layers;
  Knowledge<D> known(header);
  const auto add = [&](LayerKind kind, int level, Bytes bytes, auto tell) {
    const Bytes told = payload(tell);
    bytes.insert(bytes.end(), told.begin(), told.end());
    layers.push_back({{kind, level, 0.1, 0, 0}, bytes});
  };
  add(LayerKind::Base, 0, {}, [&](auto& ask) { known.base(ask); });
  for (int level = 1; level <= header.octaves(); ++level) add(LayerKind::Refinement, level, {}, [&](auto& ask) { known.refine(ask); });
  if (header.trimmed) add(LayerKind::Domain, header.octaves(), {}, [&](auto& ask) { known.tellDomain(ask); });
  for (const auto& pass : passes) add(pass.kind, header.octaves(), fieldsOf<D>(pass), [&](auto& ask) { known.geometry(ask, pass); });
  for (int number = 1; number <= static_cast<int>(header.near.size()); ++number) {
    add(LayerKind::NearSigns, number, {}, [&](auto& ask) { known.nearSigns(ask, number); });
    for (const auto& pass : further) {
      Bytes bytes = fieldsOf<D>(pass);
      bytes.insert(bytes.begin(), static_cast<std::byte>(pass.kind));
      add(LayerKind::NearGeometry, number, bytes, [&](auto& ask) { known.nearGeometry(ask, pass); });
    }
  }
  return assembled(header, layers);
}

/// What a decoder of volumes holds beside what is counted: its models, and the bytes that it was fed.
inline constexpr std::size_t kModels = 9u << 18;

/// The most bytes held while all is decoded, and both surfaces are made after each layer.
inline std::size_t peakOf(const Bytes& bytes, const Limits& limits, Error& error) {
  const Allocation allocation;
  Decoder decoder(limits);
  decoder.feed(bytes);
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
