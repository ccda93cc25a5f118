// From a region to the chunks that it takes.
#include "decoder/chunk_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/chunk.h"
#include "surface/frames.h"
#include "util/cold_path.h"

namespace isostar {
namespace {

/// The planes of a level between which something lies, both included.
struct PlaneBox {
  Coordinates<3> first, last;
};

/// Bounds are off by less than rounding makes of a sample's place.
constexpr double kRounding = 1e-4;

/// Of the finest level; far ones are clamped.
ISOSTAR_COLD PlaneBox planesOf(const Region& region, const Placement& placement) {
  constexpr double kFar = 1 << 29;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec3 low(kInfinity), high(-kInfinity);
  for (unsigned corner = 0; corner < 8; ++corner) {
    glm::dvec3 point;
    for (unsigned a = 0; a < 3; ++a)
      point[static_cast<int>(a)] = (corner >> a & 1) != 0 ? region.most[a] : region.least[a];
    const glm::dvec3 sample = sampleAt(placement, region.frame, point);
    low = glm::min(low, sample);
    high = glm::max(high, sample);
  }
  PlaneBox planes{};
  for (int a = 0; a < 3; ++a) {
    planes.first[a] = static_cast<int32_t>(std::floor(std::clamp(low[a] + kRounding, -kFar, kFar)));
    planes.last[a] = static_cast<int32_t>(std::ceil(std::clamp(high[a] - kRounding, -kFar, kFar)));
  }
  return planes;
}

/// The chunks that own planes.
ISOSTAR_COLD ChunkBox chunksOf(const PlaneBox& planes, const ChunkGrid<3>& grid) {
  ChunkBox box{};
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    box.count[at] = grid.count(a);
    box.first[at] = grid.at(a, planes.first[a]);
    box.last[at] = grid.at(a, planes.last[a]);
  }
  return box;
}
/// What chunks see: their own planes, and those of their halo.
ISOSTAR_COLD PlaneBox seenBy(const ChunkBox& box, const ChunkGrid<3>& grid,
                             const Lattice<3>& lattice) {
  constexpr int32_t kHalo = Chunk<3>::kHalo * kBrickSide;
  PlaneBox planes{};
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    planes.first[a] = std::max(0, grid.begin(box.first[at]) - kHalo);
    planes.last[a] = std::min(lattice.last[a], grid.end(a, box.last[at]) - 1 + kHalo);
  }
  return planes;
}

}  // namespace

ISOSTAR_COLD ChunkChoice::ChunkChoice(const Header& header, const std::optional<Region>& region)
    : finestLevel_(header.finestLevel()) {
  if (!region || header.chunkSide == 0) return;
  const Lattice<3> finest(header.base<3>().box, 1);
  PlaneBox planes = planesOf(*region, header.placement);
  for (int a = 0; a < 3; ++a) {
    isNone_ = isNone_ || planes.last[a] < 0 || planes.first[a] > finest.last[a];
    planes.first[a] = std::clamp(planes.first[a], 0, finest.last[a]);
    planes.last[a] = std::clamp(planes.last[a], 0, finest.last[a]);
  }
  const ChunkGrid<3> finestGrid(finest, header.chunkSide);
  geometry_ = chunksOf(planes, finestGrid);
  planes = seenBy(geometry_, finestGrid, finest);
  signs_.resize(static_cast<std::size_t>(finestLevel_) + 1);
  for (int level = finestLevel_;; --level) {
    const Lattice<3> lattice(finest.box, int32_t{1} << (finestLevel_ - level));
    const ChunkGrid<3> grid(lattice, header.chunkSide);
    const ChunkBox box = chunksOf(planes, grid);
    signs_[static_cast<std::size_t>(level)] = box;
    if (level == 0) return;
    planes = seenBy(box, grid, lattice);
    for (int a = 0; a < 3; ++a) {
      planes.first[a] /= 2;
      planes.last[a] = (planes.last[a] + 1) / 2;
    }
  }
}

bool ChunkBox::has(std::size_t chunk) const {
  for (std::size_t a = 0; a < 3; ++a) {
    const auto places = static_cast<std::size_t>(count[a]);
    const auto at = static_cast<int32_t>(chunk % places);
    if (at < first[a] || at > last[a]) return false;
    chunk /= places;
  }
  return true;
}

/// Displacements of coarser levels are not needed for finer ones.
bool ChunkChoice::hasAny(const LayerHead& head) const {
  if (signs_.empty() || head.sections.size() == 1) return true;
  return !isNone_ && (head.kind == LayerKind::Refinement || head.level == finestLevel_);
}

ISOSTAR_COLD bool ChunkChoice::has(const LayerHead& head, std::size_t chunk) const {
  if (signs_.empty() || head.sections.size() == 1) return true;
  const ChunkBox& box =
      head.kind == LayerKind::Refinement ? signs_[static_cast<std::size_t>(head.level)] : geometry_;
  return hasAny(head) && box.has(chunk);
}

ISOSTAR_COLD uint64_t ChunkChoice::bytes(const LayerHead& head) const {
  if (signs_.empty()) return head.bytes;
  uint64_t sum = 0;
  for (std::size_t i = 0; i < head.sections.size(); ++i) {
    if (has(head, i)) sum += head.sections[i] + checksumBytes(head.sections[i]);
  }
  return sum;
}

ISOSTAR_COLD std::vector<ByteRange> ChunkChoice::ranges(std::span<const LayerHead> heads,
                                                        uint64_t start) const {
  std::vector<ByteRange> ranges;
  for (const LayerHead& head : heads) {
    for (std::size_t i = 0; i < head.sections.size(); ++i) {
      const uint64_t end = start + head.sections[i] + checksumBytes(head.sections[i]);
      if (end > start && has(head, i)) {
        if (ranges.empty() || ranges.back().end != start) ranges.push_back({start, start});
        ranges.back().end = end;
      }
      start = end;
    }
  }
  return ranges;
}

}  // namespace isostar
