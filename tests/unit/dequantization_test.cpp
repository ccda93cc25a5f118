// Dequantization brings scalars of smooth fields nearer to the actual values, within their
// intervals, and hardly moves those of rough fields away from them.
#include "estimate/dequantization.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

namespace isostar {
namespace {

constexpr int kGradient = 4 * 10,
              kFloor = 7;  // 2^10 quantization steps per grid step; exponents are known from an
                           // eighth of that on

/// A brick's scalars within one and a half steps of the surface, known by their exponents.
template <class Field>
Scalars<3> codedOf(const BrickTable<3>& table, Field field) {
  Scalars<3> coded(table.total());
  auto& brick = coded.writable(0);
  coded.setGradient(0, kGradient);
  for (std::size_t v = 0; v < Scalars<3>::kVertices; ++v) {
    const double value = field(vertexOf<3>({}, v)) * 1024;
    if (std::abs(value) > 1536) continue;
    const auto magnitude = static_cast<uint32_t>(std::abs(value));
    const int width = magnitude < 1u << kFloor ? kFloor : std::bit_width(magnitude) - 1;
    brick.set(v, value > 0, magnitude < 1u << kFloor ? 0 : 1u << width, width);
    brick.members[0].words[v / 64] |= uint64_t{1} << v % 64;
  }
  return coded;
}

template <class Field>
double rmsError(const Scalars<3>& scalars, int finer, Field field) {
  double sum = 0;
  int count = 0;
  for (std::size_t v = 0; v < Scalars<3>::kVertices; ++v) {
    if (!scalars.at(0).knows(v)) continue;
    const double error =
        std::ldexp(scalars.at(0).value[v], -finer - 1) / 1024 - field(vertexOf<3>({}, v));
    sum += error * error, ++count;
  }
  return std::sqrt(sum / count);
}

double ball(const Coordinates<3>& v) {
  return 9.4 - std::hypot(v[0] + 3.1, v[1] + 1.7, v[2] + 2.2);
}

TEST(Dequantization, reducesTheErrorOfSmoothFields) {
  const BrickTable<3> table(Lattice<3>({7, 7, 7}, 1));
  const Scalars<3> coded = codedOf(table, ball);
  for (const int finer : {0, 4}) {
    Scalars<3> shown = coded;
    for (std::size_t v = 0; v < Scalars<3>::kVertices; ++v) {
      if (shown.at(0).knows(v)) shown.writable(0).value[v] *= 1 << finer;
    }
    const double before = rmsError(shown, finer, ball);
    Dequantization<3>::apply(table, coded, finer, shown);
    EXPECT_LT(rmsError(shown, finer, ball), 0.6 * before);
    for (std::size_t v = 0; v < Scalars<3>::kVertices; ++v) {
      ASSERT_EQ(shown.at(0).knows(v), coded.at(0).knows(v));
      if (!coded.at(0).knows(v)) continue;
      EXPECT_EQ(shown.at(0).value[v] > 0, coded.at(0).value[v] > 0);
      EXPECT_LT(std::abs(std::ldexp(shown.at(0).value[v], -finer) - coded.at(0).value[v]),
                1 << coded.at(0).width(v));
    }
  }
}

TEST(Dequantization, keepsTheErrorOfRoughFields) {
  const BrickTable<3> table(Lattice<3>({7, 7, 7}, 1));
  std::mt19937 random(3);
  std::vector<double> noise(Scalars<3>::kVertices);
  for (double& n : noise) n = std::uniform_real_distribution<double>(-1.4, 1.4)(random);
  const Scalars<3> coded =
      codedOf(table, [&](const Coordinates<3>& v) { return noise[numberOf<3>(v)]; });
  const auto field = [&](const Coordinates<3>& v) { return noise[numberOf<3>(v)]; };
  Scalars<3> shown = coded;
  const double before = rmsError(shown, 0, field);
  Dequantization<3>::apply(table, coded, 0, shown);
  EXPECT_LT(rmsError(shown, 0, field), 1.01 * before);
}

TEST(Dequantization, keepsExactScalarsAndInactiveBricks) {
  const BrickTable<3> table(Lattice<3>({7, 7, 7}, 1));
  Scalars<3> coded = codedOf(table, ball);
  auto& brick = coded.writable(0);
  std::size_t exact = 0;
  while (!brick.knows(exact)) ++exact;
  brick.set(exact, brick.value[exact] > 0, 0, 0);
  Scalars<3> shown = coded;
  Dequantization<3>::apply(table, coded, 0, shown, std::vector<uint8_t>{0});
  EXPECT_EQ(shown.at(0).value, coded.at(0).value);
  Dequantization<3>::apply(table, coded, 0, shown);
  EXPECT_NE(shown.at(0).value, coded.at(0).value);
  EXPECT_EQ(shown.at(0).value[exact], coded.at(0).value[exact]);
}

TEST(Dequantization, keepsBricksWhoseMagnitudesHaveBeenRefined) {
  const BrickTable<3> table(Lattice<3>({7, 7, 7}, 1));
  Scalars<3> coded = codedOf(table, ball);
  auto& brick = coded.writable(0);
  std::size_t refined = 0;
  while (!brick.knows(refined) || brick.low(refined) == 0) ++refined;
  brick.set(refined, brick.value[refined] > 0, brick.low(refined), brick.width(refined) - 1);
  Scalars<3> shown = coded;
  Dequantization<3>::apply(table, coded, 0, shown);
  EXPECT_EQ(shown.at(0).value, coded.at(0).value);
}

}  // namespace
}  // namespace isostar
