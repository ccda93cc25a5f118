#include "bench/figure6/octree_codec.h"

#include <memory>
#include <optional>

#include "bench/figure6/displacement_search.h"
#include "bench/figure6/octree_displacement_coder.h"
#include "bench/figure6/octree_sides.h"
#include "bench/figure6/octree_signs.h"
#include "bench/figure6/volume_signs.h"
#include "container/bytes.h"
#include "volume/placement.h"

namespace isostar::bench {
namespace {

constexpr int kPlanes = 6;

DualSurface surfaceOf(const OctreeSigns& signs, int level, const std::array<double, 3>& unit) {
  const auto grid = signs.lattice(level);
  return DualSurface(grid, unit, [&](const Coordinates<3>& v) { return signs.positive(grid, v); });
}

}  // namespace

std::vector<std::byte> encodeOctree(const Volume& volume, double isovalue,
                                    const measure::TriangleTree& surface) {
  const int levels = finestLevelOf(volume.size);
  const auto actual = signsOf(volume, isovalue);
  std::vector<std::byte> bytes;
  ByteWriter header(bytes);
  for (int32_t side : volume.size) header.varint(static_cast<uint64_t>(side));
  const auto addLayer = [&](auto code) {
    std::vector<std::byte> layer;
    RangeEncoder coder(layer);
    code(coder);
    coder.finish();
    ByteWriter(bytes).varint(layer.size());
    bytes.insert(bytes.end(), layer.begin(), layer.end());
  };
  auto signs = std::make_unique<OctreeSigns>(lastSample(volume.size), levels);
  const OctreeEncoderSide mixed(actual, levels);
  for (int level = 0; level <= levels; ++level)
    addLayer([&](RangeEncoder& coder) { signs->code(coder, mixed, level); });
  std::array<double, 3> unit = volume.placement.spacing;
  for (double& u : unit) u /= native::smallestSpacing(volume.placement);
  const auto dual = surfaceOf(*signs, levels, unit);
  const auto wanted = displacements(dual, surface);
  OctreeDisplacementCoder coder(dual);
  for (int plane = 0; plane < kPlanes; ++plane)
    addLayer([&](RangeEncoder& out) {
      coder.code(
          out, plane, [&](size_t v) { return wanted[v]; }, [] { return false; });
    });
  return bytes;
}

std::vector<OctreeLayer> octreeLayers(std::span<const std::byte> bytes) {
  ByteReader reader(bytes);
  std::array<int32_t, 3> grid{};
  for (int32_t& side : grid) side = static_cast<int32_t>(reader.varint());
  std::vector<OctreeLayer> layers;
  for (size_t at = reader.position(); at < bytes.size();) {
    ByteReader length(bytes.subspan(at));
    const uint64_t size = length.varint();
    at += length.position() + size;
    layers.push_back({at, static_cast<int>(layers.size()) <= finestLevelOf(grid)});
  }
  return layers;
}

Mesh decodeOctree(std::span<const std::byte> prefix, const std::array<double, 3>& unit) {
  ByteReader reader(prefix);
  std::array<int32_t, 3> grid{};
  for (int32_t& side : grid) side = static_cast<int32_t>(reader.varint());
  const int levels = finestLevelOf(grid);
  auto signs = std::make_unique<OctreeSigns>(lastSample(grid), levels);
  std::optional<DualSurface> dual;
  std::optional<OctreeDisplacementCoder> displaced;
  int layer = 0;
  for (size_t at = reader.position(); at < prefix.size(); ++layer) {
    ByteReader length(prefix.subspan(at));
    const uint64_t size = length.varint();
    at += length.position();
    const bool torn = length.overrun() || size > prefix.size() - at;
    if (torn && layer <= levels) break;
    RangeDecoder coder(prefix.subspan(at, torn ? prefix.size() - at : size));
    at = torn ? prefix.size() : at + size;
    if (layer <= levels) signs->code(coder, OctreeDecoderSide(), layer);
    if (layer == levels) displaced.emplace(dual.emplace(surfaceOf(*signs, levels, unit)));
    if (layer > levels)
      displaced->code(
          coder, layer - levels - 1, [](size_t) { return 0.0; },
          [&] { return torn && coder.overrun() > 0; });
  }
  if (layer == 0) return {};
  if (dual) return dual->mesh(displaced->values());
  return surfaceOf(*signs, layer - 1, unit).mesh({});
}

}  // namespace isostar::bench
