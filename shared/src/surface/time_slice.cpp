// Cuts a volume out of a sequence: copies a plane of time, or interpolates between two.
#include "surface/time_slice.h"

#include <algorithm>
#include <cmath>

namespace isostar {
namespace {

/// The plane of one time in a surface in four dimensions. A brick of three dimensions is a
/// contiguous part of one of four.
class Plane {
 public:
  Plane(const Surface<4>& surface, int32_t plane)
      : surface_(surface),
        first_(static_cast<std::size_t>(plane / kBrickSide) * surface.signs.table().stride(3)),
        local_(static_cast<std::size_t>(plane % kBrickSide)) {}

  [[nodiscard]] Brick<3> signs(std::size_t brickIndex) const {
    const auto& rows = surface_.signs.brickAt(first_ + brickIndex).rows;
    Brick<3> brick;
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(local_ * brick.rows.size()),
                brick.rows.size(), brick.rows.begin());
    return brick;
  }
  [[nodiscard]] bool has(std::size_t brickIndex) const {
    return surface_.scalars.has(first_ + brickIndex);
  }
  [[nodiscard]] int gradient(std::size_t brickIndex) const {
    return surface_.scalars.gradient(first_ + brickIndex);
  }
  /// The plane's values in a brick, as Scalars store them.
  [[nodiscard]] const int32_t* values(std::size_t brickIndex) const {
    return surface_.scalars.at(first_ + brickIndex).value.data() + local_ * Scalars<3>::kVertices;
  }

 private:
  const Surface<4>& surface_;
  std::size_t first_, local_;
};

void copyPlane(const Plane& plane, TimeSlice& slice) {
  for (std::size_t brickIndex = 0; brickIndex < slice.signs.table().total(); ++brickIndex) {
    slice.signs.put(brickIndex, plane.signs(brickIndex));
    if (!plane.has(brickIndex)) continue;
    slice.scalars.setGradient(brickIndex, plane.gradient(brickIndex));
    std::copy_n(plane.values(brickIndex), Scalars<3>::kVertices,
                slice.scalars.writable(brickIndex).value.begin());
  }
}

/// Interpolates between two planes.
class Blend {
 public:
  /// `share`: the weight of the later plane, 0 … 1.
  Blend(const Surface<4>& surface, const Plane& before, const Plane& after, double share)
      : surface_(surface), before_(before), after_(after), share_(share) {}

  void into(TimeSlice& slice) {
    const std::size_t tableSize = slice.signs.table().total();
    double largest = 1;
    for (std::size_t brickIndex = 0; brickIndex < tableSize; ++brickIndex) {
      forKnown(brickIndex,
               [&](std::size_t, double scalar) { largest = std::max(largest, std::abs(scalar)); });
    }
    const int finer = std::clamp(29 - std::ilogb(largest), 0, 12);
    for (std::size_t brickIndex = 0; brickIndex < tableSize; ++brickIndex) {
      // Where neither plane has scalars, both have the same signs.
      Brick<3> signs = before_.signs(brickIndex);
      if (before_.has(brickIndex) || after_.has(brickIndex)) {
        auto& values = slice.scalars.writable(brickIndex).value;
        forKnown(brickIndex, [&](std::size_t v, double scalar) {
          const auto size =
              static_cast<int32_t>(std::max(1L, std::lround(std::ldexp(std::abs(scalar), finer))));
          values[v] = scalar > 0 ? size : -size;
          const auto bit = static_cast<uint8_t>(1u << v % kBrickSide);
          auto& row = signs.rows[v / kBrickSide];
          row = static_cast<uint8_t>(scalar > 0 ? row | bit : row & ~bit);
        });
      }
      slice.signs.put(brickIndex, signs);
    }
  }

 private:
  /// Calls visit(vertex, scalar) where a scalar is known, in half quantization steps; it is never
  /// zero on the wrong side.
  template <class Visit>
  void forKnown(std::size_t brickIndex, Visit visit) const {
    if (!before_.has(brickIndex) && !after_.has(brickIndex)) return;
    const int32_t* a = before_.values(brickIndex);
    const int32_t* b = after_.values(brickIndex);
    for (std::size_t v = 0; v < Scalars<3>::kVertices; ++v) {
      const bool first = a[v] != Scalars<3>::kUnknown, second = b[v] != Scalars<3>::kUnknown;
      if (first && second)
        visit(v, (1 - share_) * scalar(a[v]) + share_ * scalar(b[v]));
      else if (first || second)
        visit(v, scalar(first ? a[v] : b[v]));
    }
  }
  [[nodiscard]] double scalar(int32_t value) const {
    return value >= 0 ? surface_.size(value) : -surface_.size(value);
  }

  const Surface<4>& surface_;
  const Plane& before_;
  const Plane& after_;
  double share_;
};

}  // namespace

TimeSlice sliceAt(const Surface<4>& surface, double time) {
  const auto& lattice = surface.signs.lattice();
  TimeSlice slice;
  slice.signs =
      Signs<3>(Lattice<3>({lattice.box[0], lattice.box[1], lattice.box[2]}, lattice.step));
  slice.scalars = Scalars<3>(slice.signs.table().total());
  const int32_t plane =
      std::clamp(static_cast<int32_t>(time) / lattice.step, 0, std::max(0, lattice.last[3] - 1));
  const double start = lattice.sample(3, plane), end = lattice.sample(3, plane + 1);
  if (time <= start || time >= end) {
    copyPlane(Plane(surface, time <= start ? plane : plane + 1), slice);
    slice.positiveOffset = surface.positiveOffset;
    slice.negativeOffset = surface.negativeOffset;
  } else {
    Blend(surface, Plane(surface, plane), Plane(surface, plane + 1), (time - start) / (end - start))
        .into(slice);
  }
  return slice;
}

uint64_t memoryToSlice(const Surface<4>& surface) {
  const uint64_t tableSize = surface.signs.table().stride(3), known = surface.scalars.brickCount();
  return Signs<3>::memoryToFill(tableSize, surface.signs.brickCount() + known) +
         Scalars<3>::memoryOf(tableSize, std::min(tableSize, known));
}

}  // namespace isostar
