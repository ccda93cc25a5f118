// From the signs of one refinement level to those of the next (§5.2), and which bricks of a level
// the surface may touch.
#pragma once

#include <cstring>
#include <optional>

#include "grid/signs.h"
#include "util/cold_path.h"

namespace isostar {

/// Sets the last plane on an axis where it is odd: it coincides with the coarser level's last
/// plane, but refined() first copies the plane before that one.
template <int D>
void copyEndPlane(const Signs<D>& coarse, Signs<D>& fine, int axis) {
  const auto& lattice = fine.lattice();
  Coordinates<D> v{};
  v[axis] = lattice.last[axis];
  for (;;) {
    Coordinates<D> parent;
    for (int a = 0; a < D; ++a) parent[a] = lattice.parent(a, v[a]);
    fine.set(v, coarse.at(parent));
    int a = 0;
    for (; a < D; ++a) {
      if (a == axis) continue;
      if (++v[a] <= lattice.last[a]) break;
      v[a] = 0;
    }
    if (a == D) return;
  }
}

/// The signs of the next finer level as far as the coarser level determines them: a new vertex has
/// the sign of its lower neighbour until its own is known.
template <int D>
Signs<D> refined(const Signs<D>& coarse) {
  // Each bit of a nibble twice.
  static constexpr std::array<uint8_t, 16> kTwice{0x00, 0x03, 0x0C, 0x0F, 0x30, 0x33, 0x3C, 0x3F,
                                                  0xC0, 0xC3, 0xCC, 0xCF, 0xF0, 0xF3, 0xFC, 0xFF};
  constexpr std::size_t kOddRows = (power(kBrickSide, D - 1) - 1) / (kBrickSide - 1);
  Signs<D> fine(coarse.lattice().finer());
  const auto& table = fine.table();
  Coordinates<D> at{};
  std::size_t parentsRow = 0;  // the coarser brick at its beginning
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex, table.advance(at)) {
    if (at[0] == 0) {
      Coordinates<D> half;
      for (int a = 0; a < D; ++a) half[a] = at[a] / 2;
      parentsRow = coarse.table().index(half);
    }
    const uint32_t index = coarse.slot(parentsRow + static_cast<std::size_t>(at[0] / 2));
    if (index <= Signs<D>::kPositive) {
      fine.setUniform(brickIndex, index);
      continue;
    }
    const auto& parent = coarse.brick(index).rows;
    std::size_t first = 0;  // the row of the coarser brick at which this one begins
    for (int a = D - 1; a >= 1; --a)
      first = first * kBrickSide + static_cast<std::size_t>((at[a] & 1) * 4);
    Brick<D> brick;
    for (std::size_t r = 0; r < brick.rows.size(); ++r) {
      // A row's number has an octal digit for each axis: halved, they are those of its parent.
      const std::size_t even = r & ~kOddRows;
      brick.rows[r] =
          even == r ? kTwice[parent[first + even / 2] >> ((at[0] & 1) * 4) & 15] : brick.rows[even];
    }
    fine.put(brickIndex, brick);
  }
  for (int a = 0; a < D; ++a) {
    if ((fine.lattice().last[a] & 1) != 0) copyEndPlane(coarse, fine, a);
  }
  return fine;
}

/// The most bricks that copyEndPlane() makes, on all axes.
template <int D>
ISOSTAR_COLD uint64_t mostEndBricks(const Signs<D>& coarse) {
  const auto& table = coarse.table();
  const auto finer = coarse.lattice().finer();
  uint64_t bricks = 0;
  for (int axis = 0; axis < D; ++axis) {
    if ((finer.last[axis] & 1) == 0) continue;
    Coordinates<D> low{}, high;
    for (int a = 0; a < D; ++a) high[a] = table.count(a) - 1;
    low[axis] = high[axis];
    forEachBetween<D>(low, high, [&](const Coordinates<D>& at) {
      const std::size_t brickIndex = table.index(at);
      const uint32_t slot = coarse.slot(brickIndex);
      const bool differs = at[axis] > 0 && coarse.slot(brickIndex - table.stride(axis)) != slot;
      if (slot > Signs<D>::kPositive || differs) bricks += power(2, D - 1);
    });
  }
  return bricks;
}

/// Bytes of the signs that refined() makes, at most, and of copies of them.
template <int D>
ISOSTAR_COLD uint64_t memoryOfRefined(const Signs<D>& coarse) {
  constexpr std::size_t kPage = Signs<D>::kPage;
  const BrickTable<D> finer(coarse.lattice().finer());
  const uint64_t ends = mostEndBricks<D>(coarse);
  // What is in a page of the coarser level lies in some runs along the first axis, and each of them
  // becomes 2^(D - 1) runs that are twice as long.
  const auto row = static_cast<std::size_t>(coarse.table().count(0));
  const uint64_t runs = (kPage / row + 2) * power(2, D - 1),
                 pagesOfRun = 2 * std::min(kPage, row) / kPage + 2;
  return Signs<D>::memoryToFill(finer.total(), (uint64_t{coarse.brickCount()} << D) + ends,
                                (coarse.varied() + 1) * runs * pagesOfRun + ends);
}

/// The even bits of a byte, packed into four bits.
constexpr unsigned evenBits(unsigned byte) {
  byte &= 0x55;
  byte = (byte | byte >> 1) & 0x33;
  return (byte | byte >> 2) & 0x0F;
}

/// The uniform brick that all finer bricks share which a brick of the coarser level covers; nothing
/// if they do not share one. `at`: the coarser brick's coordinates.
template <int D>
std::optional<uint32_t> uniformBelow(const Signs<D>& fine, const Coordinates<D>& at) {
  std::optional<uint32_t> common;
  for (std::size_t n = 0; n < power(2, D); ++n) {
    Coordinates<D> finer;
    for (int a = 0; a < D; ++a)
      finer[a] = std::min(at[a] * 2 + static_cast<int32_t>(n >> a & 1), fine.table().count(a) - 1);
    const uint32_t index = fine.slot(fine.table().index(finer));
    if (index > Signs<D>::kPositive || index != common.value_or(index)) return std::nullopt;
    common = index;
  }
  return common;
}

/// A brick of the coarser level. Beyond the lattice the last plane is repeated, as in the finer
/// bricks. `at`: the brick's coordinates.
template <int D>
Brick<D> coarsenedBrick(const Signs<D>& fine, const Coordinates<D>& at) {
  const auto& table = fine.table();
  Brick<D> brick;
  Coordinates<D> v{};
  for (auto& row : brick.rows) {
    Coordinates<D> finer{};
    std::size_t finerRow = 0;
    for (int a = D - 1; a >= 1; --a) {
      const int32_t plane = std::min((at[a] * kBrickSide + v[a]) * 2, fine.lattice().last[a]);
      finer[a] = plane / kBrickSide;
      finerRow = finerRow * kBrickSide + static_cast<std::size_t>(plane % kBrickSide);
    }
    const std::size_t first = table.index(finer);
    auto signsOf = [&](int32_t x) {
      const int32_t end = table.count(0) - 1;
      const unsigned signs =
          fine.brickAt(first + static_cast<std::size_t>(std::min(x, end))).rows[finerRow];
      return x <= end ? signs : (signs >> (kBrickSide - 1)) * 0xFFu;
    };
    row =
        static_cast<uint8_t>(evenBits(signsOf(at[0] * 2)) | evenBits(signsOf(at[0] * 2 + 1)) << 4);
    for (int a = 1; a < D && ++v[a] == kBrickSide; ++a) v[a] = 0;
  }
  return brick;
}

/// The signs of the next coarser level, whose vertices are a part of this level's.
template <int D>
Signs<D> coarsened(const Signs<D>& fine) {
  Signs<D> coarse(Lattice<D>(fine.lattice().box, fine.lattice().step * 2));
  const auto& table = coarse.table();
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex) {
    const auto at = table.brick(brickIndex);
    if (const auto uniform = uniformBelow<D>(fine, at)) {
      coarse.setUniform(brickIndex, *uniform);
    } else {
      coarse.put(brickIndex, coarsenedBrick<D>(fine, at));
    }
  }
  return coarse;
}

/// Does the side of a brick that faces the direction -d have a vertex whose sign is not `uniform`?
template <int D>
bool facingVaries(const Brick<D>& brick, const Coordinates<D>& d, uint32_t uniform) {
  // Eight rows, all of a plane on axes 0 and 1, are one word.
  constexpr uint64_t kEach = 0x0101010101010101;
  constexpr int kTop = kBrickSide - 1;
  const uint64_t column = d[0] == 0  ? ~uint64_t{0}
                          : d[0] > 0 ? kEach
                                     : kEach << kTop,
                 row = d[1] == 0  ? ~uint64_t{0}
                       : d[1] > 0 ? uint64_t{0xFF}
                                  : uint64_t{0xFF} << kTop * kBrickSide,
                 flip = uniform == Signs<D>::kPositive ? ~uint64_t{0} : 0;
  Coordinates<D> from{}, to{};
  for (int a = 2; a < D; ++a) {
    from[a] = d[a] < 0 ? kTop : 0;
    to[a] = d[a] > 0 ? 0 : kTop;
  }
  uint64_t varies = 0;
  for (auto v = from;;) {
    std::size_t plane = 0;
    for (int a = D - 1; a >= 2; --a) plane = plane * kBrickSide + static_cast<std::size_t>(v[a]);
    uint64_t word;
    std::memcpy(&word, &brick.rows[plane * kBrickSide], sizeof word);
    varies |= word ^ flip;
    int a = 2;
    for (; a < D && ++v[a] > to[a]; ++a) v[a] = from[a];
    if (a == D) return (varies & column & row) != 0;
  }
}

/// Does a uniform brick touch a vertex of the other sign? `at`: the brick's coordinates.
template <int D>
bool touchesOther(const Signs<D>& signs, std::size_t brickIndex, const Coordinates<D>& at) {
  const uint32_t uniform = signs.slot(brickIndex);
  const auto around = signs.table().around(at);
  for (std::size_t n = 0; n < around.size(); ++n) {
    if (around[n] == BrickTable<D>::kNowhere) continue;
    const uint32_t index = signs.slot(around[n]);
    if (index == uniform) continue;
    if (index <= Signs<D>::kPositive ||
        facingVaries<D>(signs.brick(index), BrickTable<D>::kDirections[n], uniform))
      return true;
  }
  return false;
}

/// The active bricks: 1 for each brick index whose brick holds both signs or touches a vertex of
/// the other sign, else 0.
template <int D>
std::vector<uint8_t> activeBricks(const Signs<D>& signs) {
  const auto& table = signs.table();
  std::vector<uint8_t> active(table.total(), 0);
  Coordinates<D> at{};
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex, table.advance(at)) {
    const bool mixed = signs.slot(brickIndex) > Signs<D>::kPositive;
    if (mixed) active[brickIndex] = 1;
    bool differs = false;
    for (int a = 0; a < D && !mixed; ++a) {
      differs = differs || (at[a] + 1 < table.count(a) &&
                            signs.slot(brickIndex + table.stride(a)) != signs.slot(brickIndex));
    }
    if (!mixed && !differs) continue;
    Coordinates<D> from, to;
    for (int a = 0; a < D; ++a) {
      from[a] = std::max(at[a] - 1, 0);
      // The brick that differs is one further.
      to[a] = std::min(at[a] + (mixed ? 1 : 2), table.count(a) - 1);
    }
    for (auto v = from;;) {
      uint8_t& mark = active[table.index(v)];
      if (mark == 0) mark = 2;
      int a = 0;
      for (; a < D && ++v[a] > to[a]; ++a) v[a] = from[a];
      if (a == D) break;
    }
  }
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex) {
    if (active[brickIndex] == 2)
      active[brickIndex] = touchesOther<D>(signs, brickIndex, table.brick(brickIndex)) ? 1 : 0;
  }
  return active;
}

/// Updates `active` after vertices of a brick have changed: marks the brick, and those of its
/// neighbours that now touch a vertex of the other sign.
template <int D>
void activateAround(const Signs<D>& signs, std::size_t brickIndex, std::vector<uint8_t>& active) {
  const auto& table = signs.table();
  active[brickIndex] = 1;
  const auto around = table.around(table.brick(brickIndex));
  for (std::size_t n = 0; n < around.size(); ++n) {
    const std::size_t other = around[n];
    // The direction from the neighbour to the brick is that of the opposite neighbour.
    const auto& d = BrickTable<D>::kDirections[around.size() - 1 - n];
    if (other != BrickTable<D>::kNowhere && active[other] == 0 &&
        facingVaries<D>(signs.brickAt(brickIndex), d, signs.slot(other)))
      active[other] = 1;
  }
}

}  // namespace isostar
