#include "estimate/completion.h"

#include <gtest/gtest.h>

#include "sign_fields.h"

namespace isostar {
namespace {

/// Calls visit(brick index, vertex in the brick, is positive) for each vertex of a class.
template <class Visit>
void forMembers(const Signs<3>& signs, const std::vector<uint8_t>& active, Members members,
                Visit visit) {
  Tube<3> tube;
  for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
    if (active[brickIndex] == 0) continue;
    tube.enter(signs, brickIndex, members);
    tube.forEach([&](int row, std::size_t r, int x) {
      visit(brickIndex, r * kBrickSide + static_cast<std::size_t>(x), tube.positive(row, x));
    });
  }
}

TEST(Completed, hasAScalarOfTheRightSignAtEachVertexOfTheTube) {
  const Coordinates<3> box{20, 17, 18};
  for (const auto& field : signFields<3>(box)) {
    SCOPED_TRACE(field.name);
    const auto signs = DenseSigns<3>(Lattice<3>(box, 1), field.positive).bricks();
    const auto active = activeBricks(signs);
    const Scalars<3> none(signs.table().total());
    for (const auto polygonizer : {Polygonizer::Cubes, Polygonizer::Tetrahedra}) {
      const Completed<3> completed(signs, active, none, polygonizer, {}, false);
      for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
        if (members == Members::DiagonalEnds && polygonizer == Polygonizer::Cubes) continue;
        forMembers(signs, active, members,
                   [&](std::size_t brickIndex, std::size_t v, bool positive) {
                     const auto& brick = completed.scalars.at(brickIndex);
                     ASSERT_TRUE(brick.knows(v));
                     ASSERT_NE(brick.value[v], 0);
                     ASSERT_EQ(brick.value[v] > 0, positive);
                   });
      }
    }
  }
}

TEST(Completed, keepsKnownScalars) {
  const Coordinates<3> box{15, 15, 15};
  const auto signs = DenseSigns<3>(Lattice<3>(box, 1), signFields<3>(box)[3].positive).bricks();
  const auto active = activeBricks(signs);
  Scalars<3> known(signs.table().total());
  forMembers(signs, active, Members::AxisEnds,
             [&](std::size_t brickIndex, std::size_t v, bool positive) {
               known.setGradient(brickIndex, 40);
               if (v % 3 == 0) known.writable(brickIndex).set(v, positive, 100, 2);
             });
  const Completed<3> completed(signs, active, known, Polygonizer::Cubes, {}, false);
  EXPECT_GT(completed.finer, 0);
  forMembers(signs, active, Members::AxisEnds, [&](std::size_t brickIndex, std::size_t v, bool) {
    if (!known.at(brickIndex).knows(v)) return;
    EXPECT_EQ(completed.scalars.at(brickIndex).value[v],
              known.at(brickIndex).value[v] << completed.finer);
  });
}

TEST(Completed, putsAPlaneHalfwayBetweenTheSigns) {
  const auto signs =
      DenseSigns<3>(Lattice<3>({23, 23, 23}, 1), [](const auto& v) { return v[2] > 11; }).bricks();
  const auto active = activeBricks(signs);
  const Completed<3> completed(signs, active, Scalars<3>(signs.table().total()), Polygonizer::Cubes,
                               {}, false);
  const auto valueAt = [&](int32_t z) {
    const Coordinates<3> v{12, 12, z};
    return completed.scalars.at(signs.table().brickIndexOf(v)).value[numberOf<3>(v)];
  };
  const double below = -valueAt(11), above = valueAt(12);
  EXPECT_NEAR(below / (below + above), 0.5, 0.02);
}

}  // namespace
}  // namespace isostar
