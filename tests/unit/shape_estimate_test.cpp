#include "estimate/shape_estimate.h"

#include <gtest/gtest.h>

#include "sign_fields.h"

namespace isostar {
namespace {

TEST(ShapeEstimate, givesAPlaneTheSameSlopeWithEachFilter) {
  const auto signs =
      DenseSigns<3>(Lattice<3>({23, 23, 23}, 1), [](const auto& v) { return v[0] > 11; }).bricks();
  Window<3> window;
  window.load(signs, {1, 1, 1});
  std::array<double, 3> slopes{};
  for (const SmoothingFilter filter :
       {SmoothingFilter::Narrow, SmoothingFilter::Middle, SmoothingFilter::Wide}) {
    ShapeEstimate<3> shapes(filter);
    shapes.load(window);
    slopes[static_cast<std::size_t>(filter)] =
        shapes.sum(27, 4) - shapes.sum(27, 3);  // across the plane
  }
  for (const double slope : slopes) EXPECT_NEAR(slope, slopes[2], 0.01 * slopes[2]);
}

}  // namespace
}  // namespace isostar
