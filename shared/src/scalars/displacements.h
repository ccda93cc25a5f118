// Displacements: by how much blocks of the surface lie off the place where the signs alone put
// them. They are coded before any scalars.
#pragma once

#include "grid/sparse_bricks.h"
#include "grid/tube.h"

namespace isostar {

/// What a pass codes: the displacements of cubes of 2^log2Side vertices on a side, log2Side being 1
/// … 3, in multiples of `step` units.
struct DisplacementPass {
  int log2Side = 1;
  int step = 1;
};

/// One number for each block of 2^D vertices of a brick.
template <int D>
using DisplacementBrick = std::array<int8_t, power(kBrickSide / 2, D)>;

/// A displacement for each block that has a positive end of a crossing axis edge.
template <int D>
class Displacements : public SparseBricks<DisplacementBrick<D>> {
 public:
  using Brick = DisplacementBrick<D>;
  static constexpr int kSide = kBrickSide / 2;  // blocks of a brick along an axis
  static constexpr std::size_t kBlocks = power(kSide, D);
  /// Units per grid step; positive displacements point towards positive vertices.
  static constexpr int kPerStep = 64;
  static constexpr int kPlaneSlope = 5793;  // units of a ShapeEstimate per grid step near a plane
  static constexpr int8_t kNone = -128;     // a block without a coded displacement

  Displacements() = default;
  explicit Displacements(std::size_t tableSize) : SparseBricks<Brick>(tableSize, none()) {}

  /// Adds units to a block's displacement, within ±127.
  static void move(int8_t& value, int units) {
    value = static_cast<int8_t>(std::clamp((value == kNone ? 0 : value) + units, -127, 127));
  }
  /// The number of a block, from its coordinates in units of blocks within the brick.
  [[nodiscard]] static std::size_t blockAt(const Coordinates<D>& v) {
    std::size_t block = 0;
    for (int a = D - 1; a >= 0; --a) block = block * kSide + static_cast<std::size_t>(v[a]);
    return block;
  }
  /// The block of vertex x in row r of a brick.
  [[nodiscard]] static constexpr std::size_t block(std::size_t r, int x) {
    std::size_t block = static_cast<std::size_t>(x) / 2, stride = kSide;
    for (int a = 1; a < D; ++a, r /= kBrickSide, stride *= kSide)
      block += r % kBrickSide / 2 * stride;
    return block;
  }

 private:
  [[nodiscard]] static Brick none() {
    Brick brick;
    brick.fill(kNone);
    return brick;
  }
};

}  // namespace isostar
