// A fuzzer's bytes as numbers, and what every decoder must do with untrusted input.
#pragma once

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "hostile/parts.h"

namespace isostar {

inline constexpr Limits kFuzzLimits{1u << 20, 1u << 16, 32u << 20};

/// Takes numbers off the front; past the end they are zero.
class FuzzInput {
 public:
  FuzzInput(const uint8_t* data, std::size_t size)
      : rest_(reinterpret_cast<const std::byte*>(data), size) {}

  uint8_t byte() { return number<uint8_t>(); }
  /// A number in first … last.
  int between(int first, int last) { return first + byte() % (last - first + 1); }
  template <class Number>
  Number number() {
    Number n{};
    const auto taken = bytes(sizeof(Number));
    if (!taken.empty()) std::memcpy(&n, taken.data(), taken.size());
    return n;
  }
  std::span<const std::byte> bytes(std::size_t count) {
    const auto taken = rest_.first(std::min(count, rest_.size()));
    rest_ = rest_.subspan(taken.size());
    return taken;
  }
  [[nodiscard]] std::span<const std::byte> rest() const { return rest_; }

 private:
  std::span<const std::byte> rest_;
};

inline void demand(bool actual) {
  if (!actual) std::abort();
}

inline void demandSound(const Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size() / 3;
  demand(vertices <= kFuzzLimits.vertices && mesh.normals.size() == mesh.positions.size() &&
         mesh.indices.size() % 3 == 0);
  for (uint32_t v : mesh.indices) demand(v < vertices);
  for (float v : mesh.positions) demand(std::isfinite(v));
  for (float v : mesh.normals) demand(std::isfinite(v));
}

/// Makes all meshes or contours that a decoder can show: for both polygonizers, each isovalue and
/// one in between, at a frame and between frames.
inline void demandSoundSurfaces(const Decoder& decoder) {
  std::vector<double> isovalues = decoder.info().isovalues;
  if (isovalues.size() > 1) isovalues.push_back(0.7 * isovalues.front() + 0.3 * isovalues.back());
  for (const Polygonizer polygonizer : {Polygonizer::Cubes, Polygonizer::Tetrahedra}) {
    for (const double isovalue : isovalues) {
      for (const double time : {0.0, 0.7}) {
        const MeshOptions options{polygonizer, Frame::World, true, time, isovalue};
        Mesh mesh;
        Contours contours;
        if (decoder.mesh(options, mesh) == Error::None) demandSound(mesh);
        if (time == 0) (void)decoder.contours(options, contours);
        for (float v : contours.points) demand(std::isfinite(v));
        if (decoder.info().dimension < 4) break;
      }
    }
  }
}

inline void demandHarmless(std::span<const std::byte> stream, const Limits& limits = kFuzzLimits) {
  Decoder decoder(limits);
  decoder.accept(stream);
  decoder.finish();
  while (decoder.advance()) demandSoundSurfaces(decoder);
  demand(decoder.isFinal() || decoder.error() != Error::None);
  StreamInfo info;
  (void)inspect(stream, info);
  if (!isInChunks(stream)) return;
  demandSoundSurfaces(decodedRegion(stream, limits));
  for (const Decoder& share : decodedShares(stream, limits)) {
    Mesh mesh;
    std::vector<MeshRun> runs;
    if (share.mesh({}, mesh, runs) != Error::None) continue;
    for (float v : mesh.positions) demand(std::isfinite(v));
  }
}

}  // namespace isostar
