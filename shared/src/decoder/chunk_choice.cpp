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
  const auto place = ZOrder<3>(count).place(chunk);
  for (std::size_t a = 0; a < 3; ++a) {
    if (place[a] < first[a] || place[a] > last[a]) return false;
  }
  return true;
}

/// Displacements of coarser levels are not needed for finer ones.
bool ChunkChoice::hasAny(const LayerHead& head) const {
  if (signs_.empty() || head.sections.size() == 1) return true;
  return !isNone_ && (head.kind == LayerKind::Refinement || head.level == finestLevel_);
}

const ChunkBox& ChunkChoice::boxOf(const LayerHead& head) const {
  return head.kind == LayerKind::Refinement ? signs_[static_cast<std::size_t>(head.level)]
                                            : geometry_;
}

ISOSTAR_COLD bool ChunkChoice::has(const LayerHead& head, std::size_t chunk) const {
  if (isWhole() || head.sections.size() == 1) return true;
  return hasAny(head) && boxOf(head).has(chunk);
}

ISOSTAR_COLD bool ChunkChoice::hasPage(const LayerHead& head, std::size_t page) const {
  if (isWhole()) return true;
  if (!hasAny(head)) return false;
  const ChunkBox& box = boxOf(head);
  const auto first = page * static_cast<std::size_t>(kChunksPerPage);
  const std::size_t end =
      std::min(first + static_cast<std::size_t>(kChunksPerPage), ZOrder<3>(box.count).total());
  bool any = false;
  for (std::size_t chunk = first; chunk < end && !any; ++chunk) any = box.has(chunk);
  return any;
}

ISOSTAR_COLD uint64_t ChunkChoice::bytesOfPages(const LayerHead& head) const {
  uint64_t sum = 0;
  for (std::size_t i = 0; i < head.pages.size(); ++i)
    sum += hasPage(head, i) ? wholeBytes(head.pages[i]) : 0;
  return sum;
}

ISOSTAR_COLD uint64_t ChunkChoice::bytes(const LayerHead& head) const {
  if (isWhole()) return head.bytes;
  uint64_t sum = 0;
  for (std::size_t i = 0; i < head.sections.size(); ++i) {
    if (has(head, i)) sum += head.sections[i] + checksumBytes(head.sections[i]);
  }
  return sum;
}

ISOSTAR_COLD bool ChunkChoice::addRanges(const LayerHead& head, uint64_t start,
                                         std::vector<ByteRange>& ranges) const {
  const auto add = [&](uint64_t bytes, bool isChosen) {
    if (bytes != 0 && isChosen) {
      if (ranges.empty() || ranges.back().end != start) ranges.push_back({start, start});
      ranges.back().end = start + bytes;
    }
    start += bytes;
  };
  if (isWhole()) return add(pageBytes(head) + head.bytes, true), true;
  if (!hasAny(head)) return true;
  if (!head.pages.empty() && head.sections.empty()) {
    for (std::size_t i = 0; i < head.pages.size(); ++i)
      add(wholeBytes(head.pages[i]), hasPage(head, i));
    return false;
  }
  start += pageBytes(head);
  for (std::size_t i = 0; i < head.sections.size(); ++i) {
    const std::size_t page = i / static_cast<std::size_t>(kChunksPerPage);
    if (head.pages.empty() || hasPage(head, page)) {
      add(head.sections[i] + checksumBytes(head.sections[i]), has(head, i));
    } else {
      start += head.pages[page].sections;
      i += static_cast<std::size_t>(kChunksPerPage) - 1;
    }
  }
  return true;
}

}  // namespace isostar
