#include "encoder/core/field.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "grid/refined_signs.h"
#include "sign_fields.h"

namespace isostar {
namespace {

template <int D>
Coordinates<D> sizeOf(Coordinates<D> box) {
  for (int32_t& n : box) ++n;
  return box;
}

/// Compares signs as bricks store them. Beyond the lattice they repeat its last plane.
template <int D>
void expectSigns(const Signs<D>& signs, const SignField<D>& field) {
  const auto& lattice = signs.lattice();
  Coordinates<D> whole;
  for (int a = 0; a < D; ++a) whole[a] = lattice.last[a] | (kBrickSide - 1);
  forVertices(Lattice<D>(whole, 1), [&](const Coordinates<D>& v) {
    Coordinates<D> sample;
    for (int a = 0; a < D; ++a) sample[a] = lattice.sample(a, std::min(v[a], lattice.last[a]));
    ASSERT_EQ(signs.at(v), field.positive(sample))
        << field.name << " at " << testing::PrintToString(v) << ", step " << lattice.step;
  });
}

/// Compares signs on the finest level and on all coarser ones.
template <int D>
void expectSignsOnAllLevels(const Coordinates<D>& box) {
  SCOPED_TRACE(testing::PrintToString(box));
  for (const auto& field : signFields<D>(box)) {
    std::vector<float> samples;
    forVertices(Lattice<D>(box, 1), [&](const Coordinates<D>& v) {
      samples.push_back(field.positive(v) ? 3.0f : 2.0f);
    });
    Signs<D> signs = GridField<D>(samples, sizeOf<D>(box), 2.5).signs();
    expectSigns(signs, field);
    while (std::ranges::any_of(signs.lattice().last, [](int32_t last) { return last > 1; })) {
      signs = coarsened(signs);
      expectSigns(signs, field);
    }
  }
}

TEST(Field, signsAreThoseOfTheSamplesOnEachLevel) {
  for (int32_t last = 1; last < 40; ++last) expectSignsOnAllLevels<2>({last, 40 - last});
  expectSignsOnAllLevels<2>({63, 64});
  expectSignsOnAllLevels<2>({128, 127});
  expectSignsOnAllLevels<3>({16, 33, 5});
  expectSignsOnAllLevels<3>({31, 1, 47});
  expectSignsOnAllLevels<4>({9, 4, 17, 3});
}

TEST(Field, positiveIsAboveTheIsovalueExactly) {
  constexpr float kMost = std::numeric_limits<float>::max();
  const std::vector<float> samples{-kMost, -1, -0.1f, 0, 0.1f, 1, 7, kMost};
  for (const double isovalue : {-1e300, double{-kMost}, -1.0, 0.1, double{0.1f}, 0.0, 1 + 1e-12,
                                1 - 1e-12, double{kMost}, 1e300}) {
    const GridField<3> field(samples, {2, 2, 2}, isovalue);
    const auto signs = field.signs();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto at = static_cast<int32_t>(i);
      EXPECT_EQ(signs.at({at & 1, at >> 1 & 1, at >> 2}), double{samples[i]} > isovalue)
          << samples[i] << " at isovalue " << isovalue;
    }
  }
}

TEST(Field, sensibleRefusesSamplesThatAreNotNumbers) {
  std::vector<float> samples(7 * 5 * 3, 1);
  EXPECT_TRUE(sensible<3>(samples, {7, 5, 3}, 0));
  EXPECT_FALSE(sensible<3>(samples, {7, 5, 4}, 0));
  EXPECT_FALSE(sensible<3>(samples, {7, 5, 0}, 0));
  EXPECT_FALSE(sensible<3>(samples, {7, 5, 3}, std::nan("")));
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (float& sample : samples) {
    for (const float special : {kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
      sample = special;
      EXPECT_FALSE(sensible<3>(samples, {7, 5, 3}, 0));
    }
    sample = 1;
  }
}

/// A brick's gradient is the median over all crossing edges in it and from the preceding planes.
TEST(Field, gradientIsTheMedianDifference) {
  const Coordinates<3> size{21, 17, 12};
  std::mt19937 random(5);
  std::vector<float> samples(21 * 17 * 12);
  for (float& sample : samples) sample = static_cast<float>(random() % 4096);
  const GridField<3> field(samples, size, 2048.5);
  const auto signs = field.signs();
  Header header;
  header.quantizationStep = 1;
  for (std::size_t brickIndex = 0; brickIndex < signs.table().total(); ++brickIndex) {
    const auto brick = signs.table().brick(brickIndex);
    std::vector<double> differences;
    forVertices(Lattice<3>(field.last(), 1), [&](const Coordinates<3>& v) {
      for (int a = 0; a < 3; ++a) {
        if (v[a] < brick[a] * 8 - 1 || v[a] > brick[a] * 8 + 7) return;
      }
      for (int a = 0; a < 3; ++a) {
        auto next = v;
        if (++next[a] > field.last()[a] || signs.at(next) == signs.at(v)) continue;
        differences.push_back(std::abs(field.scalar(next) - field.scalar(v)));
      }
    });
    std::ranges::sort(differences);
    const double median = differences.empty() ? 1 : differences[differences.size() / 2];
    EXPECT_EQ(field.gradient(header, signs, brickIndex),
              std::lround(4 * std::log2(std::max(1.0, median))))
        << brickIndex;
  }
}

TEST(GridField, findsTheCrossingOfAnEdgeOfEachLevel) {
  std::vector<float> samples;
  for (int x = 0; x < 12; ++x) samples.push_back(static_cast<float>(x - 6.25));
  samples.resize(24, 1.0f);
  const GridField<2> field(samples, {12, 2}, 0);
  EXPECT_DOUBLE_EQ(field.crossing({6, 0}, {7, 0}, 0), 0.25);
  EXPECT_DOUBLE_EQ(field.crossing({7, 0}, {6, 0}, 0), 0.75);
  EXPECT_DOUBLE_EQ(field.crossing({4, 0}, {8, 0}, 0), 2.25 / 4);
  EXPECT_DOUBLE_EQ(field.crossing({8, 0}, {0, 0}, 0), 1.75 / 8);
  EXPECT_DOUBLE_EQ(field.crossing({11, 0}, {4, 0}, 0), 4.75 / 7);
}

TEST(GridField, findsOneOfSeveralCrossings) {
  const std::vector<float> samples{1, -3, 1, -1, -1, 1, 1, 1};
  const GridField<2> field(samples, {4, 2}, 0);
  const double at = field.crossing({0, 0}, {3, 0}, 0) * 3;
  EXPECT_TRUE(at == 0.25 || at == 1.75 || at == 2.5) << at;
}

}  // namespace
}  // namespace isostar
