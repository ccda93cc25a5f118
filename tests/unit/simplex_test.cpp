#include "grid/simplex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace isostar {
namespace {

template <int D>
Lattice<D> smallLattice() {
  Coordinates<D> box;
  for (int a = 0; a < D; ++a) box[a] = D == 4 ? 2 : 2 + a;
  return Lattice<D>(box, 1);
}

template <int D>
std::set<Coordinates<D>> verticesOf(const Simplex<D>& s) {
  std::set<Coordinates<D>> vertices;
  for (int i = 0; i <= D; ++i) vertices.insert(s.vertex(i));
  return vertices;
}

template <int D>
std::set<Coordinates<D>> faceOf(const Simplex<D>& s, int opposite) {
  auto face = verticesOf(s);
  face.erase(s.vertex(opposite));
  return face;
}

template <class Dimension>
class SimplexTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(SimplexTest, Dimensions);

TYPED_TEST(SimplexTest, indexAndSimplexAreInverse) {
  constexpr int D = TypeParam::value;
  const auto lattice = smallLattice<D>();
  std::set<std::set<Coordinates<D>>> all;
  for (std::size_t n = 0; n < Simplex<D>::count(lattice); ++n) {
    const auto s = Simplex<D>::at(n, lattice);
    EXPECT_EQ(s.index(lattice), n);
    EXPECT_LT(s.rank(), Simplex<D>::perCell());
    EXPECT_TRUE(all.insert(verticesOf(s)).second) << "simplex " << n << " exists twice";
    for (int i = 0; i <= D; ++i) {
      for (int a = 0; a < D; ++a)
        ASSERT_TRUE(s.vertex(i)[a] >= 0 && s.vertex(i)[a] <= lattice.last[a]);
    }
  }
}

TYPED_TEST(SimplexTest, firstVertexIsEvenAndLastIsOdd) {
  constexpr int D = TypeParam::value;
  const auto lattice = smallLattice<D>();
  for (std::size_t n = 0; n < Simplex<D>::count(lattice); ++n) {
    const auto s = Simplex<D>::at(n, lattice);
    for (int a = 0; a < D; ++a) {
      EXPECT_EQ(s.vertex(0)[a] & 1, 0);
      EXPECT_EQ(s.vertex(D)[a] & 1, 1);
    }
  }
}

TYPED_TEST(SimplexTest, acrossAFaceIsTheOtherSimplexThatSharesIt) {
  constexpr int D = TypeParam::value;
  const auto lattice = smallLattice<D>();
  std::map<std::set<Coordinates<D>>, std::vector<std::size_t>> holders;
  for (std::size_t n = 0; n < Simplex<D>::count(lattice); ++n) {
    for (int i = 0; i <= D; ++i) holders[faceOf(Simplex<D>::at(n, lattice), i)].push_back(n);
  }
  for (std::size_t n = 0; n < Simplex<D>::count(lattice); ++n) {
    const auto s = Simplex<D>::at(n, lattice);
    for (int i = 0; i <= D; ++i) {
      const auto& both = holders[faceOf(s, i)];
      const auto other = s.across(i, lattice);
      ASSERT_EQ(both.size(), other ? 2u : 1u) << "simplex " << n << " face " << i;
      if (!other) continue;
      EXPECT_EQ(other->index(lattice), both[0] == n ? both[1] : both[0]);
      EXPECT_EQ(faceOf(*other, i), faceOf(s, i)) << "vertex " << i << " is the new one";
      const auto back = other->across(i, lattice);
      ASSERT_TRUE(back);
      EXPECT_EQ(back->index(lattice), n) << "the neighbour's neighbour is the simplex itself";
    }
  }
}

TYPED_TEST(SimplexTest, tilesEachCell) {
  constexpr int D = TypeParam::value;
  const auto lattice = smallLattice<D>();
  // A point lies in the simplex whose order of axes sorts its distances from the even corner in
  // descending order.
  for (std::size_t n = 0; n < Simplex<D>::count(lattice); n += Simplex<D>::perCell()) {
    std::set<std::array<int8_t, D>> orders;
    for (std::size_t i = n; i < n + Simplex<D>::perCell(); ++i) {
      const auto s = Simplex<D>::at(i, lattice);
      EXPECT_EQ(s.cell(), Simplex<D>::at(n, lattice).cell());
      EXPECT_EQ(s.vertex(0), Simplex<D>::at(n, lattice).vertex(0))
          << "all share the cell's diagonal";
      EXPECT_EQ(s.vertex(D), Simplex<D>::at(n, lattice).vertex(D));
      orders.insert(s.axes);
    }
    EXPECT_EQ(orders.size(), Simplex<D>::perCell());
  }
}

TYPED_TEST(SimplexTest, adjacentCellsMirrorEachOther) {
  constexpr int D = TypeParam::value;
  const auto lattice = smallLattice<D>();
  for (std::size_t n = 0; n < Simplex<D>::count(lattice); ++n) {
    const auto s = Simplex<D>::at(n, lattice);
    for (int a = 0; a < D; ++a) {
      auto cell = s.cell();
      if (++cell[a] >= lattice.last[a]) continue;
      std::set<Coordinates<D>> mirrored;
      for (auto v : verticesOf(s)) {
        v[a] = 2 * cell[a] - v[a];
        mirrored.insert(v);
      }
      EXPECT_EQ(mirrored, verticesOf(Simplex<D>::inCell(cell, s.rank())));
    }
  }
}

TYPED_TEST(SimplexTest, aBoxWithoutExtentHasNoSimplices) {
  constexpr int D = TypeParam::value;
  Coordinates<D> box;
  box.fill(3);
  box[D - 1] = 0;
  EXPECT_EQ(Simplex<D>::count(Lattice<D>(box, 1)), 0u);
}

}  // namespace
}  // namespace isostar
