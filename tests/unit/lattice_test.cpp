#include "grid/lattice.h"

#include <gtest/gtest.h>

#include <set>

namespace isostar {
namespace {

/// Each box with up to 20 samples along its side, with each step that is a power of two up to 32.
template <class Check>
void forEachAxis(Check check) {
  for (int32_t box = 0; box < 20; ++box) {
    for (int32_t step = 1; step <= 32; step *= 2) {
      SCOPED_TRACE(testing::Message() << "last sample " << box << ", step " << step);
      check(Lattice<1>({box}, step));
    }
  }
}

TEST(Lattice, planesAreTheMultiplesOfTheStepAndTheEndOfTheBox) {
  forEachAxis([](const Lattice<1>& lattice) {
    std::set<int32_t> expected{lattice.box[0]};
    for (int32_t s = 0; s < lattice.box[0]; s += lattice.step) expected.insert(s);
    std::set<int32_t> found;
    for (int32_t plane = 0; plane <= lattice.last[0]; ++plane)
      EXPECT_TRUE(found.insert(lattice.sample(0, plane)).second) << "plane " << plane;
    EXPECT_EQ(found, expected);
    EXPECT_EQ(lattice.vertices(), expected.size());
  });
}

TEST(Lattice, finerKeepsEachPlane) {
  forEachAxis([](const Lattice<1>& coarse) {
    if (coarse.step == 1) return;
    const auto fine = coarse.finer();
    std::set<int32_t> parents;
    for (int32_t plane = 0; plane <= fine.last[0]; ++plane) {
      const int32_t parent = fine.parent(0, plane);
      ASSERT_GE(parent, 0);
      ASSERT_LE(parent, coarse.last[0]);
      if (fine.isNew(0, plane)) {
        EXPECT_LT(coarse.sample(0, parent), fine.sample(0, plane));
        ASSERT_LT(parent, coarse.last[0]) << "a new plane has one after it";
        EXPECT_GT(coarse.sample(0, parent + 1), fine.sample(0, plane));
        EXPECT_EQ(fine.sample(0, plane - 1), coarse.sample(0, parent))
            << "its neighbours are not new";
        EXPECT_EQ(fine.sample(0, plane + 1), coarse.sample(0, parent + 1));
      } else {
        EXPECT_EQ(coarse.sample(0, parent), fine.sample(0, plane));
        EXPECT_TRUE(parents.insert(parent).second);
      }
    }
    EXPECT_EQ(static_cast<int32_t>(parents.size()), coarse.last[0] + 1)
        << "each plane of the coarser level is kept";
  });
}

TEST(Lattice, refiningEndsAtTheGridOfTheSource) {
  forEachAxis([](Lattice<1> lattice) {
    while (lattice.step > 1) lattice = lattice.finer();
    EXPECT_EQ(lattice.last, lattice.box);
    for (int32_t plane = 0; plane <= lattice.last[0]; ++plane)
      EXPECT_EQ(lattice.sample(0, plane), plane);
  });
}

TEST(Lattice, mirroredStaysInsideAndKeepsTheDistance) {
  forEachAxis([](const Lattice<1>& lattice) {
    for (int32_t plane = -2; plane <= lattice.last[0] + 2; ++plane) {
      const int32_t mirrored = lattice.mirrored(0, plane);
      EXPECT_GE(mirrored, 0);
      EXPECT_LE(mirrored, lattice.last[0]);
      if (lattice.last[0] < 2) continue;
      const int32_t wall = plane < 0 ? 0 : lattice.last[0];
      EXPECT_EQ(mirrored, plane < 0 || plane > lattice.last[0] ? 2 * wall - plane : plane);
    }
  });
}

TEST(Lattice, axesAreIndependent) {
  const Lattice<3> lattice({4, 0, 9}, 4);
  EXPECT_EQ(lattice.last, (Coordinates<3>{1, 0, 3}));
  EXPECT_EQ(lattice.vertices(), 2u * 1 * 4);
  EXPECT_EQ(lattice.finer().last, (Coordinates<3>{2, 0, 5}));
  EXPECT_EQ(lattice.finer().finer().last, (Coordinates<3>{4, 0, 9}));
}

TEST(Lattice, holdsHugeBoxes) {
  const int32_t most = (1 << 28) - 1;
  const Lattice<3> lattice({most, most, 1}, 1 << 28);
  EXPECT_EQ(lattice.last, (Coordinates<3>{1, 1, 1}));
  EXPECT_EQ(lattice.sample(0, 1), most);
}

}  // namespace
}  // namespace isostar
