// The numbers of a mesh's vertices: one for each crossing edge, brick by brick.
#pragma once

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "scalars/crossings.h"
#include "surface/corner_signs.h"
#include "surface/edge_index.h"
#include "util/cold_path.h"
#include "util/decodes_all.h"

namespace isostar {

/// Bricks are named by their slots: their order among the active ones.
class EdgeNumbers {
 public:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// Nothing if it would take more than `memory` bytes.
  [[nodiscard]] ISOSTAR_COLD static std::optional<EdgeNumbers> of(const Signs<3>& signs,
                                                                  Polygonizer polygonizer,
                                                                  uint64_t memory) {
    const uint64_t marks = signs.table().total();
    if (marks > memory) return std::nullopt;
    const auto active = activeBricks(signs);
    const auto bricks = static_cast<std::size_t>(std::count(active.begin(), active.end(), 1));
    if (marks + Slots::memoryOf(marks, bricks) + bricks * sizeof(std::size_t) > memory)
      return std::nullopt;
    EdgeNumbers numbers(signs, polygonizer);
    numbers.bricks_.reserve(bricks);
    for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
      if (active[brickIndex] == 0) continue;
      numbers.slot_.set(brickIndex, static_cast<uint32_t>(numbers.bricks_.size()));
      numbers.bricks_.push_back(brickIndex);
    }
    return numbers;
  }

  [[nodiscard]] std::size_t bricks() const { return bricks_.size(); }
  [[nodiscard]] std::size_t brickIndex(std::size_t slot) const { return bricks_[slot]; }
  /// kNone for a brick without edges.
  [[nodiscard]] uint32_t slot(std::size_t brickIndex) const { return slot_[brickIndex]; }
  /// Along sets of axes from 1 to this one there are edges, as far as uses() says.
  [[nodiscard]] unsigned lastAxes() const { return hasDiagonals() ? 7u : 4u; }
  [[nodiscard]] bool uses(unsigned axes) const {
    return hasDiagonals() || std::has_single_bit(axes);
  }
  [[nodiscard]] const EdgeIndex& of(std::size_t slot, unsigned axes) const {
    return index_[slot * sets() + numbers_[axes]];
  }

  /// The number of a brick's first vertex, or of the next one if it has none.
  [[nodiscard]] uint32_t firstVertex(std::size_t slot) const {
    return index_[slot * sets()].planes[0].first;
  }

  /// Bytes that makeRoom() takes.
  [[nodiscard]] uint64_t memory() const {
    return slot_.memory() + bricks_.size() * (sets() * sizeof(EdgeIndex) + sizeof(std::size_t));
  }
  void makeRoom() { index_.resize(bricks_.size() * sets()); }
  /// Numbers the vertices of a brick from `first` on; returns the next number.
  uint32_t count(std::size_t slot, uint32_t first) {
    const CornerSigns corners(*signs_, bricks_[slot]);
    const auto brick = signs_->table().brick(bricks_[slot]);
    for (unsigned axes = 1; axes <= lastAxes(); ++axes) {
      if (!uses(axes)) continue;
      EdgeIndex& index = index_[slot * sets() + numbers_[axes]];
      const auto inside = insideOf(signs_->lattice(), brick, axes);
      for (unsigned z = 0; z < kPlanes; ++z) {
        const uint64_t crossed = corners.crossedEdges(axes, z) & inside[z];
        index.planes[z] = {crossed, first};
        first += static_cast<uint32_t>(std::popcount(crossed));
      }
    }
    return first;
  }
  /// Adds to the numbers of a brick.
  void shift(std::size_t slot, uint32_t by) {
    for (std::size_t set = 0; set < sets(); ++set) {
      for (auto& plane : index_[slot * sets() + set].planes) plane.first += by;
    }
  }

 private:
  using Slots = BrickMap<uint32_t, kNone>;

  EdgeNumbers(const Signs<3>& signs, Polygonizer polygonizer)
      : signs_(&signs),
        polygonizer_(polygonizer),
        numbers_(numbersOfSets(polygonizer)),
        slot_(signs.table().total()) {}

  /// How many sets of axes there are along which edges run.
  [[nodiscard]] std::size_t sets() const { return hasDiagonals() ? 7 : 3; }
  [[nodiscard]] bool hasDiagonals() const {
    return kDecodesAll && polygonizer_ == Polygonizer::Tetrahedra;
  }
  /// Of a set of axes: its number among those used.
  [[nodiscard]] static std::array<uint8_t, 8> numbersOfSets(Polygonizer polygonizer) {
    if (polygonizer == Polygonizer::Cubes) return {0, 0, 1, 0, 2, 0, 0, 0};
    return {0, 0, 1, 2, 3, 4, 5, 6};
  }

  const Signs<3>* signs_;
  Polygonizer polygonizer_;
  std::array<uint8_t, 8> numbers_;
  Slots slot_;                       // by brick index
  std::vector<std::size_t> bricks_;  // brick indices, by slot
  std::vector<EdgeIndex> index_;     // by slot, then by number of the set of axes
};

}  // namespace isostar
