#include <gtest/gtest.h>

#include "bisection/weld_topology.h"

namespace isostar {
namespace {

/// The vertex whose edge runs along the first axis, in the middle of a box; `link` gives the signs
/// around the edge.
template <int D, class Link>
bool keepsInTheMiddle(bool vertex, bool evenEnd, bool oddEnd, Link link) {
  Coordinates<D> box, v;
  box.fill(4);
  v.fill(2);
  v[0] = 1;
  const Hierarchy<D> hierarchy(box, 2);
  return weldKeepsTopology(hierarchy, v, [&](const Coordinates<D>& u) {
    if (u[0] != 1) return u[0] == 0 ? evenEnd : oddEnd;
    Coordinates<D> offset;
    for (int a = 0; a < D; ++a) offset[a] = u[a] - v[a];
    return u == v ? vertex : static_cast<bool>(link(offset));
  });
}

TEST(WeldTopology, anEdgeCrossedAtMostOnceMayBeWelded) {
  for (unsigned signs = 0; signs < 256; ++signs) {
    auto any = [&](const Coordinates<3>& o) {
      return (signs >> ((o[1] + 1) * 3 + o[2] + 1) % 8 & 1) != 0;
    };
    for (bool vertex : {false, true}) {
      EXPECT_TRUE(keepsInTheMiddle<3>(vertex, vertex, vertex, any));
      EXPECT_TRUE(keepsInTheMiddle<3>(vertex, !vertex, vertex, any));
      EXPECT_TRUE(keepsInTheMiddle<3>(vertex, vertex, !vertex, any));
    }
  }
}

TEST(WeldTopology, refusesASaddleInTwoDimensions) {
  EXPECT_FALSE(keepsInTheMiddle<2>(false, true, true, [](const auto&) { return false; }))
      << "a bridge";
  EXPECT_FALSE(keepsInTheMiddle<2>(false, true, true, [](const auto&) { return true; }))
      << "a hole";
  EXPECT_TRUE(keepsInTheMiddle<2>(false, true, true, [](const auto& o) { return o[1] > 0; }))
      << "a dent";
}

TEST(WeldTopology, allowsOnlyADentWhereAnEdgeIsCrossedTwice) {
  auto keeps = [](auto link) { return keepsInTheMiddle<3>(false, true, true, link); };
  EXPECT_FALSE(keeps([](const auto&) { return false; })) << "a rod torn in two";
  EXPECT_FALSE(keeps([](const auto&) { return true; })) << "a bubble";
  EXPECT_FALSE(keeps([](const auto& o) { return o[1] != 0; })) << "a tunnel";
  EXPECT_TRUE(keeps([](const auto& o) { return o[1] > 0; })) << "a dent";
  EXPECT_TRUE(keeps([](const auto& o) { return o[1] == 1 && o[2] == 1; }))
      << "one vertex holds the ends together";
}

TEST(WeldTopology, oneEulerCharacteristicIsNotEnoughInFourDimensions) {
  // Around the edge is a sphere. A cap, two rings and a cap of alternating signs have the Euler
  // characteristics 1 + 0 and 0 + 1.
  auto caps = [](const Coordinates<4>& o) {
    const bool middle = o[1] == 0 && o[2] == 0;
    return o[3] == 0 || (o[3] == 1 && middle);
  };
  EXPECT_FALSE(keepsInTheMiddle<4>(false, true, true, caps));
  EXPECT_TRUE(
      keepsInTheMiddle<4>(false, true, true, [](const Coordinates<4>& o) { return o[3] > 0; }));
}

TEST(WeldTopology, holdsAtTheEndOfTheBox) {
  // x = 2 is the last sample, inside a cell that ends at 4. The cell's centre and the corners
  // beyond it lie at the end of the box.
  const Hierarchy<3> hierarchy({2, 4, 4}, 2);
  const Coordinates<3> v{2, 2, 2};
  EXPECT_TRUE(weldKeepsTopology(hierarchy, v, [](const Coordinates<3>& u) { return u[0] >= 2; }));
  EXPECT_FALSE(weldKeepsTopology(hierarchy, v, [&](const Coordinates<3>& u) {
    return u == v || u[0] < 2;
  })) << "an opening";
  // A vertex at the position of its edge's end changes nothing.
  EXPECT_TRUE(weldKeepsTopology(hierarchy, {2, 0, 0},
                                [](const Coordinates<3>& u) { return u[0] >= 2 && u[1] == 0; }));
}

}  // namespace
}  // namespace isostar
