#include "encoder/core/displacement_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "coding/geometry/displacement_coder.h"
#include "grid/refined_signs.h"
#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

const RunTasks kInOrder;

/// Samples of a function on a grid of 33³.
std::vector<float> sampled(double (*f)(double, double, double)) {
  std::vector<float> samples;
  for (int z = 0; z < 33; ++z) {
    for (int y = 0; y < 33; ++y) {
      for (int x = 0; x < 33; ++x) samples.push_back(static_cast<float>(f(x, y, z)));
    }
  }
  return samples;
}

/// The error that remains after passes of cubes with 4 and 2 vertices on a side, as a share of the
/// error of the signs alone. `coarser`: the number of levels below the finest.
double remainingError(double (*f)(double, double, double), SmoothingFilter filter,
                      int coarser = 0) {
  const auto samples = sampled(f);
  const GridField<3> field(samples, {33, 33, 33}, 0);
  auto signs = field.signs();
  while (coarser-- > 0) signs = coarsened(signs);
  const auto active = activeBricks(signs);
  const DisplacementPlan<3> plan(field, signs, active, filter, kInOrder);
  const double first = plan.error({});
  Displacements<3> reached;
  for (const DisplacementPass& pass : {DisplacementPass{2, 12}, {1, 12}, {1, 3}})
    reached = plan.reached(reached, plan.next(reached, pass).steps, pass);
  return plan.error(reached) / first;
}

TEST(DisplacementPlan, locatesTheSurfaceBetterThanTheSigns) {
  for (const SmoothingFilter filter :
       {SmoothingFilter::Narrow, SmoothingFilter::Middle, SmoothingFilter::Wide}) {
    EXPECT_LT(remainingError([](double, double, double z) { return z - 15.85; }, filter), 0.1);
    EXPECT_LT(remainingError([](double x, double y,
                                double z) { return 11.3 - std::hypot(x - 16, y - 16, z - 16); },
                             filter),
              0.7);
  }
}

TEST(DisplacementPlan, locatesTheSurfaceBetterThanTheSignsOfCoarserLevels) {
  for (const int coarser : {1, 2}) {
    EXPECT_LT(remainingError([](double, double, double z) { return z - 13.3; },
                             SmoothingFilter::Narrow, coarser),
              0.15)
        << coarser;
    EXPECT_LT(remainingError([](double x, double y,
                                double z) { return 11.3 - std::hypot(x - 16, y - 16, z - 16); },
                             SmoothingFilter::Narrow, coarser),
              0.8)
        << coarser;
  }
}

TEST(DisplacementPlan, reachesWhatTheCoderCodes) {
  const auto samples = sampled(
      [](double x, double y, double z) { return 11.3 - std::hypot(x - 16, y - 16, z - 16); });
  const GridField<3> field(samples, {33, 33, 33}, 0);
  const auto signs = field.signs();
  const auto active = activeBricks(signs);
  const DisplacementPlan<3> plan(field, signs, active, SmoothingFilter::Wide, kInOrder);
  struct Planned : NoScalars {
    [[nodiscard]] int displacement(std::size_t brickIndex, std::size_t block) const {
      return steps.at(brickIndex)[block];
    }
    Displacements<3> steps;
  } planned;
  DisplacementCoder<3> coder;
  Displacements<3> displacements(active.size());
  for (const DisplacementPass& pass : {DisplacementPass{2, 12}, {1, 12}, {1, 6}}) {
    planned.steps = plan.next(displacements, pass).steps;
    const auto reached = plan.reached(displacements, planned.steps, pass);
    (void)coded<3>(signs, planned, [&](auto& exchange) {
      coder.code(exchange, signs, displacements, pass, active);
    });
    for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
      if (active[brickIndex] != 0) {
        ASSERT_EQ(displacements.at(brickIndex), reached.at(brickIndex));
      }
    }
  }
}

}  // namespace
}  // namespace isostar
