#include "grid/neighbourhood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "grid/simplex.h"

namespace isostar {
namespace {

template <class Dimension>
class NeighbourhoodTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(NeighbourhoodTest, Dimensions);

/// The coordinates of a NeighbourOffset; they are unique within two planes.
template <int D>
Coordinates<D> offset(const NeighbourOffset& step) {
  Coordinates<D> d{};
  d[0] = step.bits;
  int rows = step.rows;
  for (int a = D - 1; a >= 1; --a) {
    const int stride = Window<D>::rowStride(a);
    d[a] = (rows + stride * 100 + stride / 2) / stride - 100;
    rows -= d[a] * stride;
  }
  EXPECT_EQ(rows, 0);
  return d;
}

template <int D>
std::set<Coordinates<D>> offsets(const std::array<NeighbourOffset, Neighbourhood<D>::kMost>& steps,
                                 int from, int count) {
  std::set<Coordinates<D>> all;
  for (int i = from; i < from + count; ++i)
    EXPECT_TRUE(all.insert(offset<D>(steps[static_cast<std::size_t>(i)])).second);
  return all;
}

/// The number of new axes of a neighbour: 0 for a vertex of the coarser level.
template <int D>
int classOf(unsigned newAxes, const Coordinates<D>& d) {
  int axes = 0;
  for (int a = 0; a < D; ++a) axes += ((newAxes >> a & 1) ^ static_cast<unsigned>(d[a] & 1)) != 0;
  return axes;
}

TYPED_TEST(NeighbourhoodTest, diamondsHaveTheTheoreticalSizes) {
  constexpr int D = TypeParam::value;
  for (unsigned newAxes = 1; newAxes < 1u << D; ++newAxes) {
    const int axes = __builtin_popcount(newAxes);
    const Neighbourhood<D> n(newAxes);
    EXPECT_EQ(n.cornerCount, 1 << axes);
    EXPECT_EQ(n.acrossCount, static_cast<int>(power(3, D - axes)) - 1);
  }
}

TEST(Neighbourhood, diamondsInThreeDimensionsHoldCornersAndCentres) {
  const Neighbourhood<3> cell(7), face(3), edge(1);
  EXPECT_EQ(cell.cornerCount + cell.acrossCount, 8) << "a cell's centre has the cell's corners";
  EXPECT_EQ(face.cornerCount, 4) << "a face's centre has the face's corners";
  EXPECT_EQ(face.acrossCount, 2) << "and the centres of both cells";
  EXPECT_EQ(edge.cornerCount, 2) << "an edge's midpoint has the edge's ends";
  EXPECT_EQ(edge.acrossCount, 8) << "and the centres of four faces and four cells";
}

TYPED_TEST(NeighbourhoodTest, diamondsHoldVerticesOfEarlierClassesOnly) {
  constexpr int D = TypeParam::value;
  for (unsigned newAxes = 1; newAxes < 1u << D; ++newAxes) {
    const Neighbourhood<D> n(newAxes);
    const int own = __builtin_popcount(newAxes);
    for (const auto& d : offsets<D>(n.diamond, 0, n.cornerCount))
      EXPECT_EQ(classOf<D>(newAxes, d), 0);
    for (const auto& d : offsets<D>(n.diamond, n.cornerCount, n.acrossCount))
      EXPECT_GT(classOf<D>(newAxes, d), own);
  }
}

TYPED_TEST(NeighbourhoodTest, siblingsAreOfTheSameClassAndPrecede) {
  constexpr int D = TypeParam::value;
  for (unsigned newAxes = 1; newAxes < 1u << D; ++newAxes) {
    const Neighbourhood<D> n(newAxes);
    for (const auto& d : offsets<D>(n.siblings, 0, n.siblingCount)) {
      EXPECT_EQ(classOf<D>(newAxes, d), __builtin_popcount(newAxes));
      EXPECT_TRUE(std::lexicographical_compare(d.rbegin(), d.rend(), Coordinates<D>{}.rbegin(),
                                               Coordinates<D>{}.rend()));
    }
  }
}

TYPED_TEST(NeighbourhoodTest, listsDoNotOverlapAndStayInTheWindow) {
  constexpr int D = TypeParam::value;
  for (unsigned newAxes = 1; newAxes < 1u << D; ++newAxes) {
    const Neighbourhood<D> n(newAxes);
    auto all = offsets<D>(n.diamond, 0, n.diamondCount());
    const std::size_t diamond = all.size();
    all.merge(offsets<D>(n.siblings, 0, n.siblingCount));
    EXPECT_EQ(all.size(), diamond + static_cast<std::size_t>(n.siblingCount));
    EXPECT_FALSE(all.contains(Coordinates<D>{}));
    for (const auto& d : all) {
      for (int32_t x : d) EXPECT_LE(std::abs(x), Window<D>::kHalo);
    }
  }
}

TYPED_TEST(NeighbourhoodTest, slicesAndMasksCountNoneAndAll) {
  constexpr int D = TypeParam::value;
  using N = Neighbourhood<D>;
  RowPacks<D> none, all;
  for (auto& word : all.words) word = (uint64_t{1} << 5 * Window<D>::kSide) - 1;
  constexpr int kAt = Window<D>::kHalo;
  for (unsigned newAxes = 1; newAxes < 1u << D; ++newAxes) {
    const N n(newAxes);
    auto weight = [&](const RowPacks<D>& packs) {
      return N::unpacked(packs.diamond(n.slices, kAt)).weight +
             static_cast<int>(packs.count(n.farMask, kAt)) * N::kFarOne +
             static_cast<int>(packs.count(n.outerMask, kAt)) * N::kOuterOne;
    };
    EXPECT_EQ(weight(none), 0);
    EXPECT_EQ(weight(all), n.weight);
    const auto seen = N::unpacked(all.diamond(n.slices, kAt));
    EXPECT_EQ(static_cast<int>(seen.corners), n.cornerCount);
    EXPECT_EQ(static_cast<int>(seen.across), n.acrossCount);
    EXPECT_EQ(seen.diamond, (1u << std::min(n.diamondCount(), N::kDiamondBits)) - 1);
    EXPECT_LE(static_cast<int>(all.count(n.siblingMask, kAt)), N::kSiblings);
    EXPECT_LE(static_cast<int>(all.count(n.farMask, kAt)), N::kFar);
    EXPECT_LE(static_cast<int>(all.count(n.outerMask, kAt)), N::kOuter);
  }
}

TYPED_TEST(NeighbourhoodTest, diamondIsAllSimplicesAroundTheSplitEdge) {
  constexpr int D = TypeParam::value;
  // All simplices with the cell's diagonal have the cell's corners, and no more.
  std::set<Coordinates<D>> seen;
  for (uint32_t rank = 0; rank < Simplex<D>::perCell(); ++rank) {
    const auto s = Simplex<D>::inCell(Coordinates<D>{}, rank);
    for (int i = 0; i <= D; ++i) {
      Coordinates<D> d;
      for (int a = 0; a < D; ++a) d[a] = 2 * s.vertex(i)[a] - 1;
      seen.insert(d);
    }
  }
  const Neighbourhood<D> centre((1u << D) - 1);
  EXPECT_EQ(offsets<D>(centre.diamond, 0, centre.diamondCount()), seen);
}

}  // namespace
}  // namespace isostar
