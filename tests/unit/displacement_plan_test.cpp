#include "encoder/core/displacement_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "coding/geometry/displacement_coder.h"
#include "grid/refined_signs.h"
#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

/// Steps that depend on place and block only.
struct ScatteredSteps : NoScalars {
  [[nodiscard]] int displacement(std::size_t brickIndex, std::size_t block) const {
    const std::size_t n = brickIndex * 131 + block * 17;
    return n % 3 == 0 ? static_cast<int>(n % 9) - 4 : 0;
  }
};

template <int D>
void hearsWhatIsTold(const Coordinates<D>& box) {
  const Lattice<D> lattice(box, 1);
  for (const auto& field : signFields<D>(box)) {
    const auto signs = DenseSigns<D>(lattice, field.positive).bricks();
    const auto active = activeBricks(signs);
    DisplacementCoder<D> mine, theirs;
    Displacements<D> coded(active.size()), decoded(active.size());
    for (const DisplacementPass& pass :
         {DisplacementPass{3, 20}, {2, 12}, {1, 12}, {1, 3}, {2, 1}}) {
      const auto bytes = isostar::coded<D>(signs, ScatteredSteps(), [&](auto& exchange) {
        mine.code(exchange, signs, coded, pass, active);
      });
      RangeDecoder coder(bytes);
      DecoderExchange<D> exchange(coder, 8, UINT64_MAX);
      theirs.code(exchange, signs, decoded, pass, active);
      ASSERT_FALSE(exchange.exhausted()) << field.name;
      for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex)
        ASSERT_EQ(coded.at(brickIndex), decoded.at(brickIndex)) << field.name;
    }
  }
}

TEST(Displacement, isHeardAsTold) {
  hearsWhatIsTold<2>({40, 23});
  hearsWhatIsTold<3>({20, 17, 9});
  hearsWhatIsTold<4>({9, 6, 10, 8});
}

TEST(Displacement, endsWhereTheBytesEnd) {
  const auto signs =
      DenseSigns<3>(Lattice<3>({30, 30, 30}, 1), signFields<3>({30, 30, 30}).front().positive)
          .bricks();
  const auto active = activeBricks(signs);
  DisplacementCoder<3> coder;
  Displacements<3> coded(active.size());
  RangeDecoder nothing({});
  DecoderExchange<3> exchange(nothing, 0, UINT64_MAX);
  coder.code(exchange, signs, coded, {1, 1}, active);
  EXPECT_TRUE(exchange.exhausted());
}

/// Samples of a function in 33³.
std::vector<float> sampled(double (*f)(double, double, double)) {
  std::vector<float> samples;
  for (int z = 0; z < 33; ++z) {
    for (int y = 0; y < 33; ++y) {
      for (int x = 0; x < 33; ++x) samples.push_back(static_cast<float>(f(x, y, z)));
    }
  }
  return samples;
}

/// The error that is left after cubes of 4 and of 2 vertices, of what the signs alone leave; so
/// many octaves before the finest.
double left(double (*f)(double, double, double), SmoothingFilter filter, int coarser = 0) {
  const auto samples = sampled(f);
  const GridField<3> field(samples, {33, 33, 33}, 0);
  auto signs = field.signs();
  while (coarser-- > 0) signs = coarsened(signs);
  const auto active = activeBricks(signs);
  const DisplacementPlan<3> plan(field, signs, active, filter);
  const double first = plan.error({});
  Displacements<3> reached;
  for (const DisplacementPass& pass : {DisplacementPass{2, 12}, {1, 12}, {1, 3}})
    reached = plan.reached(reached, plan.next(reached, pass).steps, pass);
  return plan.error(reached) / first;
}

TEST(Displacement, findsWhatSignsLeaveOpen) {
  for (const SmoothingFilter filter :
       {SmoothingFilter::Narrow, SmoothingFilter::Middle, SmoothingFilter::Wide}) {
    EXPECT_LT(left([](double, double, double z) { return z - 15.85; }, filter), 0.1);
    EXPECT_LT(
        left([](double x, double y, double z) { return 11.3 - std::hypot(x - 16, y - 16, z - 16); },
             filter),
        0.7);
  }
}

TEST(Displacement, findsWhatSignsOfCoarserOctavesLeaveOpen) {
  for (const int coarser : {1, 2}) {
    EXPECT_LT(
        left([](double, double, double z) { return z - 13.3; }, SmoothingFilter::Narrow, coarser),
        0.15)
        << coarser;
    EXPECT_LT(
        left([](double x, double y, double z) { return 11.3 - std::hypot(x - 16, y - 16, z - 16); },
             SmoothingFilter::Narrow, coarser),
        0.8)
        << coarser;
  }
}

TEST(Displacement, whatIsPlannedIsWhatIsTold) {
  const auto samples = sampled(
      [](double x, double y, double z) { return 11.3 - std::hypot(x - 16, y - 16, z - 16); });
  const GridField<3> field(samples, {33, 33, 33}, 0);
  const auto signs = field.signs();
  const auto active = activeBricks(signs);
  const DisplacementPlan<3> plan(field, signs, active, SmoothingFilter::Wide);
  struct Planned : NoScalars {
    [[nodiscard]] int displacement(std::size_t brickIndex, std::size_t block) const {
      return steps.at(brickIndex)[block];
    }
    Displacements<3> steps;
  } planned;
  DisplacementCoder<3> coder;
  Displacements<3> coded(active.size());
  for (const DisplacementPass& pass : {DisplacementPass{2, 12}, {1, 12}, {1, 6}}) {
    planned.steps = plan.next(coded, pass).steps;
    const auto reached = plan.reached(coded, planned.steps, pass);
    (void)isostar::coded<3>(
        signs, planned, [&](auto& exchange) { coder.code(exchange, signs, coded, pass, active); });
    for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
      if (active[brickIndex] != 0) {
        ASSERT_EQ(coded.at(brickIndex), reached.at(brickIndex));
      }
    }
  }
}

TEST(Displacement, isSmoothBetweenBlocks) {
  const Lattice<3> lattice({23, 23, 23}, 1);
  const BrickTable<3> table(lattice);
  Displacements<3> displacements(table.total());
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex) {
    auto& brick = displacements.writable(brickIndex);
    for (std::size_t block = 0; block < brick.size(); ++block) {
      brick[block] =
          (brickIndex + block) % 5 == 0
              ? Displacements<3>::kNone
              : static_cast<int8_t>(static_cast<int>(brickIndex * 64 + block) * 37 % 255 - 127);
    }
  }
  DisplacementWindow<3> window;
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex) {
    window.load(displacements, table, table.brick(brickIndex));
    window.spread();
    for (std::size_t r = 0; r < 64; ++r) {
      for (int x = 0; x < 8; ++x) {
        const int32_t slow =
            window.smooth({x, static_cast<int32_t>(r % 8), static_cast<int32_t>(r / 8)});
        ASSERT_NEAR(window.at(r, x), slow, 2 + std::abs(slow) / 256);
      }
    }
  }
}

/// The largest sums: 4^D weights of ±127.
template <int D>
void holdsTheFarthest() {
  Coordinates<D> box;
  box.fill(23);
  const BrickTable<D> table{Lattice<D>(box, 1)};
  for (const int far : {127, -127}) {
    Displacements<D> displacements(table.total());
    for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex)
      displacements.writable(brickIndex).fill(static_cast<int8_t>(far));
    Coordinates<D> middle;
    middle.fill(1);
    DisplacementWindow<D> window;
    window.load(displacements, table, middle);
    window.spread();
    const int expected = far * Displacements<D>::kPlaneSlope / Displacements<D>::kPerStep;
    for (std::size_t r = 0; r < power(kBrickSide, D - 1); ++r) {
      for (int x = 0; x < kBrickSide; ++x)
        ASSERT_NEAR(window.at(r, x), expected, 2 + std::abs(expected) / 128);
    }
  }
}

TEST(Displacement, theFarthestIsHeldInEachDimension) {
  holdsTheFarthest<2>();
  holdsTheFarthest<3>();
  holdsTheFarthest<4>();
}

TEST(Shape, aPlaneHasTheSameSlopeInEachKernel) {
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
