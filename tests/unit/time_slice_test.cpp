#include "surface/time_slice.h"

#include <gtest/gtest.h>

#include "dense_signs.h"

namespace isostar {
namespace {

constexpr Coordinates<4> kBox{9, 4, 3, 10};
const Lattice<4> kLattice(kBox, 1);

/// A linear field, odd everywhere, as Scalars store values.
int32_t valueAt(const Coordinates<4>& v) {
  return 2 * (7 * v[0] - 5 * v[1] + 3 * v[2] - 4 * v[3]) + 1;
}

/// Signs and scalars of all vertices.
struct Sequence4 {
  Signs<4> signs = DenseSigns<4>(kLattice, [](const auto& v) { return valueAt(v) > 0; }).bricks();
  Scalars<4> scalars{signs.table().total()};
  Placement placement;

  Sequence4() {
    forVertices(kLattice, [&](const Coordinates<4>& v) {
      scalars.writable(signs.table().brickIndexOf(v)).value[numberOf<4>(v)] = valueAt(v);
    });
  }
  [[nodiscard]] Surface<4> surface() const { return {signs, scalars, 0.25, 0.75, placement}; }
};

/// Calls visit(vertex in three dimensions, its sign in the slice, its value).
template <class Visit>
void forSlice(const TimeSlice& slice, Visit visit) {
  const auto& table = slice.signs.table();
  forVertices(slice.signs.lattice(), [&](const Coordinates<3>& v) {
    visit(v, slice.signs.at(v), slice.scalars.at(table.brickIndexOf(v)).value[numberOf<3>(v)]);
  });
}

TEST(TimeSlice, isThePlaneOfAFrame) {
  const Sequence4 sequence;
  for (const int32_t frame : {0, 1, 7, 8, 10}) {
    const TimeSlice slice = sliceAt(sequence.surface(), frame);
    EXPECT_EQ(slice.positiveOffset, 0.25);
    EXPECT_EQ(slice.negativeOffset, 0.75);
    forSlice(slice, [&](const Coordinates<3>& v, bool positive, int32_t value) {
      const int32_t expected = valueAt({v[0], v[1], v[2], frame});
      EXPECT_EQ(positive, expected > 0);
      EXPECT_EQ(value, expected);
    });
  }
}

TEST(TimeSlice, isClampedToTheSequence) {
  const Sequence4 sequence;
  forSlice(sliceAt(sequence.surface(), -3), [&](const Coordinates<3>& v, bool, int32_t value) {
    EXPECT_EQ(value, valueAt({v[0], v[1], v[2], 0}));
  });
  forSlice(sliceAt(sequence.surface(), 99), [&](const Coordinates<3>& v, bool, int32_t value) {
    EXPECT_EQ(value, valueAt({v[0], v[1], v[2], kBox[3]}));
  });
}

TEST(TimeSlice, isInterpolatedBetweenFrames) {
  const Sequence4 sequence;
  const auto exact = [](const Coordinates<4>& v) {
    const int32_t value = valueAt(v);
    return value > 0 ? value + 0.25 : value - 0.75;
  };
  constexpr double kShare = 0.25;
  const TimeSlice slice = sliceAt(sequence.surface(), 6 + kShare);
  EXPECT_EQ(slice.positiveOffset, 0);
  EXPECT_EQ(slice.negativeOffset, 0);
  forSlice(slice, [&](const Coordinates<3>& v, bool positive, int32_t value) {
    const double expected =
        (1 - kShare) * exact({v[0], v[1], v[2], 6}) + kShare * exact({v[0], v[1], v[2], 7});
    EXPECT_EQ(positive, expected > 0);
    EXPECT_NEAR(value / 4096.0, expected, 1.0 / 4096) << "2^-12 half steps";
  });
}

}  // namespace
}  // namespace isostar
