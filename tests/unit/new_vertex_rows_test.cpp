#include "grid/new_vertex_rows.h"

#include <gtest/gtest.h>

#include "sign_fields.h"

namespace isostar {
namespace {

template <class Dimension>
class NewVertexRowsTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(NewVertexRowsTest, Dimensions);

template <int D>
std::vector<Coordinates<D>> boxes() {
  if constexpr (D == 2) return {{1, 2}, {16, 17}, {31, 9}};
  if constexpr (D == 3) return {{2, 2, 2}, {5, 7, 3}, {17, 9, 12}};
  if constexpr (D == 4) return {{2, 3, 4, 5}, {9, 4, 3, 2}};
}

/// The number of positive vertices of a diamond and of all its vertices, by the definition.
template <int D>
std::pair<int, int> positivesOfDiamond(const DenseSigns<D>& signs, const Coordinates<D>& v,
                                       unsigned newAxes) {
  int positives = 0, all = 0;
  Coordinates<D> low, high;
  low.fill(-1);
  high.fill(1);
  forEachBetween<D>(low, high, [&](const Coordinates<D>& d) {
    bool corner = true, across = false, beside = true;
    Coordinates<D> w;
    for (int a = 0; a < D; ++a) {
      const bool isNewAxis = (newAxes >> a & 1) != 0;
      corner = corner && (d[a] != 0) == isNewAxis;
      beside = beside && (d[a] == 0 || !isNewAxis);
      across = across || d[a] != 0;
      w[a] = v[a] + d[a];
    }
    if (!corner && !(beside && across)) return;
    ++all;
    positives += signs.mirroredAt(w) ? 1 : 0;
  });
  return {positives, all};
}

/// Calls visit(vertex, its row, its number in the row) for the members of all classes in all
/// bricks.
template <int D, class Visit>
void forEachNewMember(const Signs<D>& signs, const Signs<D>& absent, Visit visit) {
  NewVertexRows<D> rows;
  for (int dimension = 1; dimension <= D; ++dimension) {
    for (std::size_t brickIndex = 0; brickIndex < signs.table().total(); ++brickIndex) {
      rows.enter(signs, &absent, brickIndex, dimension);
      for (int i = 0; i < rows.count(); ++i) {
        const auto& row = rows.row(i);
        EXPECT_EQ(std::popcount(unsigned{row.newAxes}), dimension);
        for (uint32_t members = row.members; members != 0; members &= members - 1) {
          const int x = std::countr_zero(members);
          visit(vertexOf<D>(signs.table().brick(brickIndex),
                            row.brick * std::size_t{kBrickSide} + static_cast<std::size_t>(x)),
                row, x);
        }
      }
    }
  }
}

TYPED_TEST(NewVertexRowsTest, areOpenOrAbsentByTheirDiamonds) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Lattice<D> lattice(box, 1);
    const DenseSigns<D> gone(lattice,
                             [](const Coordinates<D>& v) { return scrambled<D>(v, 9) % 30 == 0; });
    uint64_t expected = 0;
    forVertices(lattice,
                [&](const Coordinates<D>& v) { expected += lattice.newAxes(v) != 0 ? 1 : 0; });
    for (const auto& field : signFields<D>(box)) {
      SCOPED_TRACE(field.name + " in " + testing::PrintToString(box));
      const DenseSigns<D> actual(lattice, field.positive);
      uint64_t seen = 0;
      forEachNewMember(
          actual.bricks(), gone.bricks(), [&](const Coordinates<D>& v, const auto& row, int x) {
            const unsigned newAxes = lattice.newAxes(v);
            const auto [positives, all] = positivesOfDiamond<D>(actual, v, newAxes);
            const bool absent = positivesOfDiamond<D>(gone, v, newAxes).first != 0;
            EXPECT_EQ(newAxes, row.newAxes) << testing::PrintToString(v);
            EXPECT_EQ((row.absent >> x & 1) != 0, absent) << testing::PrintToString(v);
            EXPECT_EQ((row.open >> x & 1) != 0, !absent && positives != 0 && positives != all)
                << testing::PrintToString(v);
            ++seen;
          });
      EXPECT_EQ(seen, expected);
    }
  }
}

}  // namespace
}  // namespace isostar
