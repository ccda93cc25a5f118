#include "estimate/prediction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dense_signs.h"

namespace isostar {
namespace {

constexpr int kGradient = 4 * 10;          // 2^10 quantization steps per grid step
constexpr double kHalfSteps = 2 * 1024.0;  // per grid step

/// A plane through the middle brick of 24^3 vertices, `level` steps above its first vertex.
struct Plane {
  double level;
  [[nodiscard]] double at(int32_t z) const { return (z - 8 - level) * kHalfSteps; }
};

/// Predicts vertex (4, 4, z) of the middle brick. `known`: are its neighbours' scalars known?
Prediction<3> predicted(const Plane& plane, int32_t z, bool known) {
  const auto signs = DenseSigns<3>(Lattice<3>({23, 23, 23}, 1), [&](const auto& v) {
                       return plane.at(v[2]) > 0;
                     }).bricks();
  const Coordinates<3> middle{1, 1, 1};
  Tube<3> tube;
  tube.enter(signs, signs.table().index(middle), Members::AxisEnds);
  ShapeEstimate<3> shapes(SmoothingFilter::Middle);
  shapes.load(tube.window());
  ScalarWindow<3> window;
  window.value.fill(Scalars<3>::kUnknown);
  const auto r = static_cast<std::size_t>(4 + 8 * z);
  const int here = ScalarWindow<3>::index(r, 4);
  for (int axis = 0; known && axis < 3; ++axis) {
    for (const int side : {-1, 1})
      window.value[static_cast<std::size_t>(here + side * ScalarWindow<3>::stride(axis))] =
          static_cast<int32_t>(plane.at(8 + z + (axis == 2 ? side : 0)));
  }
  return Prediction<3>::of(shapes, window, tube, Window<3>::row({4, 4, z}), r, 4,
                           plane.at(8 + z) > 0, SizeUnit(kGradient), 0);
}

TEST(Prediction, findsAPlaneFromKnownNeighbours) {
  for (const double level : {3.2, 3.5, 3.9}) {
    for (const int32_t z : {3, 4}) {
      const Plane plane{level};
      const auto found = predicted(plane, z, true);
      EXPECT_EQ(found.known, 6);
      EXPECT_EQ(found.crossings, 1);
      EXPECT_EQ(found.others, 1);
      EXPECT_NEAR(found.magnitude, std::abs(plane.at(8 + z)), 4) << level << ", " << z;
    }
  }
}

TEST(Prediction, putsAPlaneBetweenTheSignsWithoutNeighbours) {
  for (const int32_t z : {3, 4}) {
    const auto found = predicted({3.5}, z, false);
    EXPECT_EQ(found.known, 0);
    EXPECT_NEAR(found.magnitude, kHalfSteps / 2, kHalfSteps / 8);
    EXPECT_EQ(found.own, predicted({3.1}, z, false).own) << "only the signs count";
  }
}

TEST(SlopeUnit, doublesWhereTheGradientDoubles) {
  for (int quarters = 32; quarters < 100; ++quarters) {
    const double ratio = static_cast<double>(SlopeUnit(quarters + 4).times(5793)) /
                         static_cast<double>(SlopeUnit(quarters).times(5793));
    EXPECT_NEAR(ratio, 2, 0.01) << quarters;
  }
  EXPECT_NEAR(static_cast<double>(SlopeUnit(kGradient).times(5793)), kHalfSteps, 4);
  EXPECT_EQ(SlopeUnit(0).eighth(), 1);
}

TEST(SizeUnit, keepsGradientsWithin18Bits) {
  for (int gradient = 0; gradient <= 4 * 31 + 3; ++gradient) {
    const SizeUnit unit(gradient);
    EXPECT_LT(unit.steps.times(5793), 1 << 20) << gradient;
    EXPECT_GE(unit.shift, 0);
  }
  EXPECT_EQ(SizeUnit(kGradient).shift, 0);
}

}  // namespace
}  // namespace isostar
