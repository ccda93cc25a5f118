#include "encoder/core/vertex_cloud.h"

#include <gtest/gtest.h>

#include <random>

#include "sign_fields.h"

namespace isostar {
namespace {

double squared(const std::array<double, 3>& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

/// The middle of each crossing edge. It lies within half a step of the vertex.
std::vector<std::array<double, 3>> middles(const Signs<3>& signs,
                                           const std::array<double, 3>& unit) {
  std::vector<std::array<double, 3>> all;
  const auto& lattice = signs.lattice();
  forVertices(lattice, [&](const Coordinates<3>& v) {
    for (int a = 0; a < 3; ++a) {
      auto next = v;
      if (++next[a] > lattice.last[a] || signs.at(next) == signs.at(v)) continue;
      std::array<double, 3> p;
      for (int b = 0; b < 3; ++b)
        p[b] = (lattice.sample(b, v[b]) + lattice.sample(b, next[b])) / 2.0 * unit[b];
      all.push_back(p);
    }
  });
  return all;
}

TEST(VertexCloud, findsTheNearestVertex) {
  const Coordinates<3> box{70, 41, 100};
  const std::array<double, 3> unit{1, 1.5, 2};
  std::mt19937 random(3);
  for (const int32_t step : {2, 4, 8}) {
    for (const auto& field : signFields<3>(box)) {
      const auto signs = DenseSigns<3>(Lattice<3>(box, step), field.positive).bricks();
      const auto edges = middles(signs, unit);
      const VertexCloud<3> cloud(signs, unit, {SmoothingFilter::Middle});
      ASSERT_EQ(cloud.empty(), edges.empty()) << field.name;
      for (int i = 0; i < 50 && !edges.empty(); ++i) {
        std::array<double, 3> p;
        for (int a = 0; a < 3; ++a)
          p[a] = static_cast<double>(random() % 1000) / 1000 * box[a] * unit[a];
        double nearest = 1e30;
        for (const auto& edge : edges)
          nearest = std::min(nearest, squared({edge[0] - p[0], edge[1] - p[1], edge[2] - p[2]}));
        EXPECT_NEAR(std::sqrt(squared(cloud.toNearest(p))), std::sqrt(nearest),
                    step / 2.0 * 2 + 1e-9)
            << field.name << ", step " << step;
      }
    }
  }
}

TEST(VertexCloud, endsItsSearchHoweverFarAxesAreStretched) {
  const Coordinates<3> box{40, 16, 16};
  const auto field = signFields<3>(box).front();
  const auto signs = DenseSigns<3>(Lattice<3>(box, 2), field.positive).bricks();
  const VertexCloud<3> cloud(signs, {1, 1, 1e12}, {SmoothingFilter::Middle});
  ASSERT_FALSE(cloud.empty());
  EXPECT_TRUE(std::isfinite(squared(cloud.toNearest({0, 0, 16e12}))));
}

}  // namespace
}  // namespace isostar
