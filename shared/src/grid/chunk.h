// Chunks: cubes of a level's cells that are coded independently of each other.
#pragma once

#include "grid/signs.h"
#include "grid/z_order.h"
#include "util/cold_path.h"

namespace isostar {

/// A part of a level. It owns bricks; its own lattice also has a halo of bricks around them, so
/// that windows reach no further than that lattice, and parents' signs can be refined in it.
template <int D>
struct Chunk {
  /// Two bricks, so that the halo is whole bricks of the coarser level, too.
  static constexpr int32_t kHalo = 2;

  Coordinates<D> begin{}, end{};  // the bricks owned, begin … end - 1, in the level's coordinates
  Coordinates<D> origin{};        // the first brick of `lattice`, in the level's coordinates
  Lattice<D> lattice;

  /// The lattice of the next coarser level over the same samples.
  [[nodiscard]] Lattice<D> coarser() const { return {lattice.box, lattice.step * 2}; }
  /// For each brick of a table of this chunk's own, its index in the table of the whole level;
  /// BrickTable::kNowhere for one beyond the whole lattice. `step`: 1 for this level, 2 for the
  /// next coarser one.
  [[nodiscard]] ISOSTAR_COLD std::vector<std::size_t> indicesIn(const BrickTable<D>& whole,
                                                                const BrickTable<D>& own,
                                                                int32_t step) const {
    std::vector<std::size_t> indices(own.total());
    for (std::size_t i = 0; i < indices.size(); ++i) {
      auto brick = own.brick(i);
      bool inside = true;
      for (int a = 0; a < D; ++a) {
        brick[a] += origin[a] / step;
        inside = inside && brick[a] < whole.count(a);
      }
      indices[i] = inside ? whole.index(brick) : BrickTable<D>::kNowhere;
    }
    return indices;
  }
  /// By brick index in the table of `lattice`: 1 for a brick of the halo.
  [[nodiscard]] ISOSTAR_COLD std::vector<uint8_t> halo() const {
    const BrickTable<D> own(lattice);
    std::vector<uint8_t> marks(own.total());
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const auto brick = own.brick(i);
      for (int a = 0; a < D; ++a) {
        const int32_t at = brick[a] + origin[a];
        if (at < begin[a] || at >= end[a]) marks[i] = 1;
      }
    }
    return marks;
  }
};

/// Calls visit(brick index in the level's table) for each brick that a chunk owns.
template <int D, class Visit>
void forEachBrickOf(const Chunk<D>& chunk, const BrickTable<D>& level, Visit visit) {
  Coordinates<D> last = chunk.end;
  for (int a = 0; a < D; ++a) --last[a];
  forEachBetween<D>(chunk.begin, last,
                    [&](const Coordinates<D>& brick) { visit(level.index(brick)); });
}

/// The chunks of a level.
template <int D>
class ChunkGrid {
 public:
  /// `side`: of a chunk, in cells, a multiple of 16. A last plane beyond the last whole chunk
  /// belongs to that one.
  ChunkGrid(const Lattice<D>& level, int32_t side) : level_(level), table_(level), side_(side) {
    for (int a = 0; a < D; ++a) count_[a] = std::max(1, (level.last[a] + side - 1) / side);
  }

  [[nodiscard]] std::size_t total() const { return ZOrder<D>(count_).total(); }
  /// How many chunks there are on an axis.
  [[nodiscard]] int32_t count(int axis) const { return count_[axis]; }
  /// The chunk, by its place on an axis, that owns a plane.
  [[nodiscard]] int32_t at(int axis, int32_t plane) const {
    return std::min(plane / side_, count_[axis] - 1);
  }
  /// The first plane of a chunk, by its place on an axis.
  [[nodiscard]] int32_t begin(int32_t at) const { return at * side_; }
  /// The first plane that a chunk does not own.
  [[nodiscard]] int32_t end(int axis, int32_t at) const {
    return at + 1 == count_[axis] ? level_.last[axis] + 1 : (at + 1) * side_;
  }
  /// Calls visit(number) for a chunk and those beside it.
  template <class Visit>
  void forEachAround(std::size_t number, Visit visit) const {
    const ZOrder<D> order(count_);
    auto low = order.place(number), high = low;
    for (int a = 0; a < D; ++a) {
      low[a] = std::max(low[a] - 1, 0);
      high[a] = std::min(high[a] + 1, count_[a] - 1);
    }
    forEachBetween<D>(low, high, [&](const Coordinates<D>& at) { visit(order.number(at)); });
  }
  /// Chunk 0 … total() - 1, in Z-order.
  [[nodiscard]] ISOSTAR_COLD Chunk<D> chunk(std::size_t number) const {
    Chunk<D> chunk;
    Coordinates<D> box;
    const auto place = ZOrder<D>(count_).place(number);
    for (int a = 0; a < D; ++a) {
      const int32_t at = place[a];
      const bool last = at + 1 == count_[a];
      chunk.begin[a] = at * (side_ / kBrickSide);
      chunk.end[a] = last ? table_.count(a) : (at + 1) * (side_ / kBrickSide);
      chunk.origin[a] = std::max(0, chunk.begin[a] - Chunk<D>::kHalo);
      const int32_t first = chunk.origin[a] * kBrickSide;
      const int32_t plane = (chunk.end[a] + Chunk<D>::kHalo) * kBrickSide;
      box[a] = (last || plane > level_.last[a] ? level_.box[a] : level_.sample(a, plane)) -
               first * level_.step;
    }
    chunk.lattice = Lattice<D>(box, level_.step);
    return chunk;
  }

 private:
  Lattice<D> level_;
  BrickTable<D> table_;
  int32_t side_;
  Coordinates<D> count_{};
};

/// The signs of a part of a lattice. `indices`: as of Chunk::indicesIn().
template <int D>
[[nodiscard]] ISOSTAR_COLD Signs<D> cropped(const Signs<D>& whole, const Lattice<D>& part,
                                            const std::vector<std::size_t>& indices) {
  Signs<D> signs(part);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] != BrickTable<D>::kNowhere) signs.put(i, whole.brickAt(indices[i]));
  }
  return signs;
}

}  // namespace isostar
