// Any sequence of splits and welds leaves a conforming, regular mesh (§4.3).
#include "bisection/rbmt.h"

#include "rbmt_checks.h"

namespace isostar {
namespace {

template <class Dimension>
class RbmtTransitionsTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(RbmtTransitionsTest, Dimensions);

/// The order of splits alone, by brute force: the vertices that must be split before v, or welded
/// before it.
template <int D, class Next>
Points<D> reachable(const Coordinates<D>& v, Next next) {
  Points<D> all{v};
  std::vector<Coordinates<D>> open{v};
  while (!open.empty()) {
    const auto u = open.back();
    open.pop_back();
    for (const auto& other : next(u)) {
      if (all.insert(other).second) open.push_back(other);
    }
  }
  return all;
}
template <int D>
Points<D> missingByForce(const Rbmt<D>& mesh, const typename Hierarchy<D>::Vertex& v) {
  const auto& h = mesh.hierarchy();
  return reachable<D>(v, [&](const Coordinates<D>& u) {
    std::vector<Coordinates<D>> next;
    h.forEachParent(h.diamond(u), [&](const auto& p) {
      if (!mesh.contains(p)) next.push_back(p);
    });
    return next;
  });
}
template <int D>
Points<D> dependentsByForce(const Rbmt<D>& mesh, const typename Hierarchy<D>::Vertex& v) {
  const auto& h = mesh.hierarchy();
  return reachable<D>(v, [&](const Coordinates<D>& u) {
    std::vector<Coordinates<D>> next;
    for (const auto& other : verticesOf(mesh)) {
      h.forEachParent(h.diamond(other), [&](const auto& p) {
        if (p == u) next.push_back(other);
      });
    }
    return next;
  });
}

TYPED_TEST(RbmtTransitionsTest, anySequenceLeavesAConformingRegularMesh) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(testing::Message()
                   << "box " << box.last[0] << ' ' << box.last[1] << ", seed " << seed);
      std::mt19937 random(seed);
      auto mesh = seed == 3 ? Rbmt<D>::full(hierarchy) : Rbmt<D>(hierarchy);
      typename Rbmt<D>::Vertices changed;
      for (int step = 0; step < 40; ++step) {
        const auto v = anyVertex(hierarchy, random);
        if (random() % 3 != 0) {
          mesh.split(v, changed);
          EXPECT_TRUE(mesh.contains(v));
        } else {
          mesh.weld(v, changed);
          EXPECT_FALSE(mesh.contains(v));
        }
        if (step % 8 == 7) expectConformingAndRegular(mesh);
        if (this->HasFatalFailure()) return;
      }
      expectClosed(mesh);
    }
  }
}

TYPED_TEST(RbmtTransitionsTest, transitionsAreLeastAndInOrder) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    std::mt19937 random(7);
    Rbmt<D> mesh(hierarchy);
    typename Rbmt<D>::Vertices planned, changed, local;
    for (int step = 0; step < 20; ++step) {
      const auto v = anyVertex(hierarchy, random);
      const bool weld = mesh.contains(v);
      weld ? mesh.dependents(v, planned) : mesh.missing(v, planned);
      EXPECT_EQ(planned.back(), v);
      EXPECT_EQ(Points<D>(planned.begin(), planned.end()),
                weld ? dependentsByForce(mesh, v) : missingByForce(mesh, v));
      EXPECT_EQ(planned.size() == 1, weld ? mesh.canWeld(v) : mesh.canSplit(v));
      auto bySteps = mesh;
      for (const auto& u : planned) {
        EXPECT_TRUE(weld ? bySteps.canWeld(u) : bySteps.canSplit(u));
        weld ? bySteps.weld(u, local) : bySteps.split(u, local);
        EXPECT_EQ(local.size(), 1u);
      }
      weld ? mesh.weld(v, changed) : mesh.split(v, changed);
      EXPECT_EQ(changed, planned);
      EXPECT_TRUE(verticesOf(mesh) == verticesOf(bySteps));
    }
  }
}

TYPED_TEST(RbmtTransitionsTest, aWeldUndoesItsSplit) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    std::mt19937 random(11);
    Rbmt<D> mesh(hierarchy);
    typename Rbmt<D>::Vertices added, removed;
    for (int step = 0; step < 20; ++step) {
      const auto v = anyVertex(hierarchy, random);
      const auto before = verticesOf(mesh);
      mesh.split(v, added);
      const auto after = verticesOf(mesh);
      if (!added.empty()) {
        const auto first = added.front();
        mesh.weld(first, removed);
        EXPECT_TRUE(std::find(removed.begin(), removed.end(), v) != removed.end());
        for (auto u = added.rbegin(); u != added.rend(); ++u) mesh.weld(*u, removed);
        EXPECT_TRUE(verticesOf(mesh) == before);
      }
      mesh.split(v, added);
      EXPECT_TRUE(verticesOf(mesh) == after);
    }
  }
}

TYPED_TEST(RbmtTransitionsTest, parentsAreTheNewestVerticesAround) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    for (const auto& v : verticesOf(Rbmt<D>::full(hierarchy))) {
      const auto d = hierarchy.diamond(v);
      Points<D> parents, newest;
      hierarchy.forEachParent(d, [&](const auto& p) { EXPECT_TRUE(parents.insert(p).second); });
      forEachSimplexOf(d, hierarchy, [&](const TaggedSimplex<D>& s) {
        EXPECT_EQ(s.middle(), v);
        EXPECT_EQ(s.depth, d.depth - 1);
        newest.insert(s.vertices[s.tag == D ? 1 : s.tag + 1]);
      });
      EXPECT_TRUE(parents == newest);
      for (const auto& p : parents) {
        EXPECT_TRUE(hierarchy.holds(p));
        EXPECT_EQ(hierarchy.isBase(p) ? 0 : hierarchy.diamond(p).depth, d.depth - 1);
      }
    }
  }
}

TYPED_TEST(RbmtTransitionsTest, theClosedFormOfADiamondIsTheMeshAroundItsEdge) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    std::mt19937 random(13);
    for (int step = 0; step < 12; ++step) {
      const auto v = anyVertex(hierarchy, random);
      Rbmt<D> mesh(hierarchy);
      typename Rbmt<D>::Vertices changed;
      mesh.split(v, changed);
      mesh.weld(v, changed);
      std::set<std::array<Coordinates<D>, D + 1>> closed, around;
      forEachSimplexOf(hierarchy.diamond(v), hierarchy, [&](const TaggedSimplex<D>& s) {
        EXPECT_TRUE(closed.insert(s.vertices).second);
        EXPECT_EQ(volumeOf(hierarchy, s) < 0, s.mirrored);
      });
      for (const auto& leaf : leavesOf(mesh)) {
        if (leaf.depth < hierarchy.maxDepth() && leaf.middle() == v) around.insert(leaf.vertices);
      }
      EXPECT_TRUE(closed == around);
    }
  }
}

TYPED_TEST(RbmtTransitionsTest, starsAreTheLeavesThatHaveTheVertex) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    std::mt19937 random(17);
    Rbmt<D> mesh(hierarchy);
    typename Rbmt<D>::Vertices changed;
    for (int step = 0; step < 6; ++step) mesh.split(anyVertex(hierarchy, random), changed);
    std::map<Coordinates<D>, std::set<std::array<Coordinates<D>, D + 1>>> holders;
    for (const auto& leaf : leavesOf(mesh)) {
      for (const auto& v : leaf.vertices) holders[v].insert(leaf.vertices);
    }
    for (const auto& [v, leaves] : holders) {
      std::set<std::array<Coordinates<D>, D + 1>> star;
      forEachLeafAround(
          mesh, v, [&](const TaggedSimplex<D>& s) { EXPECT_TRUE(star.insert(s.vertices).second); });
      EXPECT_TRUE(star == leaves);
    }
  }
}

/// The refinement levels of the RBMT are those of the codec: Kuhn simplices on the planes of a
/// Lattice.
TYPED_TEST(RbmtTransitionsTest, wholeLevelsAreTheLatticesOfTheCodec) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    Rbmt<D> mesh(hierarchy);
    for (int level = 0; level <= box.finestLevel; ++level) {
      const Lattice<D> lattice(box.last, int32_t{1} << (box.finestLevel - level));
      std::set<Points<D>> leaves, simplices;
      for (const auto& leaf : leavesOf(mesh)) leaves.insert(pointsOf(hierarchy, leaf));
      for (std::size_t n = 0; n < Simplex<D>::count(lattice); ++n) {
        Points<D> points;
        for (int i = 0; i <= D; ++i) {
          auto v = Simplex<D>::at(n, lattice).vertex(i);
          for (int a = 0; a < D; ++a) v[a] = lattice.sample(a, v[a]);
          points.insert(v);
        }
        simplices.insert(points);
      }
      EXPECT_TRUE(leaves == simplices) << "level " << level;
      const auto full = Rbmt<D>::full(hierarchy);
      typename Rbmt<D>::Vertices added;
      for (int depth = level * D + 1; level < box.finestLevel && depth <= level * D + D; ++depth) {
        full.forEachVertex(depth, [&](const Coordinates<D>& v) {
          EXPECT_TRUE(mesh.canSplit(v));
          mesh.split(v, added);
        });
        expectConformingAndRegular(mesh);
      }
    }
    EXPECT_TRUE(verticesOf(mesh) == verticesOf(Rbmt<D>::full(hierarchy)));
  }
}

TEST(RbmtTransitions, leaveBoxesOfAllShapesConforming) {
  struct {
    Coordinates<3> last;
    int finestLevel;
  } const cases[] = {{{1, 1, 20}, 3}, {{6, 4, 8}, 3}, {{32, 32, 32}, 3}, {{63, 32, 31}, 3}};
  for (const auto& box : cases) {
    const Hierarchy<3> hierarchy(box.last, box.finestLevel);
    Rbmt<3> mesh(hierarchy);
    std::mt19937 random(19);
    Rbmt<3>::Vertices changed;
    for (int step = 0; step < 60; ++step) {
      const auto v = anyVertex(hierarchy, random);
      random() % 4 != 0 ? mesh.split(v, changed) : mesh.weld(v, changed);
    }
    expectConformingAndRegular(mesh);
    expectClosed(mesh);
  }
}

TEST(RbmtTransitions, leaveABoxWithoutExtentEmpty) {
  const Hierarchy<3> hierarchy({0, 5, 5}, 2);
  EXPECT_TRUE(leavesOf(Rbmt<3>::full(hierarchy)).empty());
  Rbmt<3> mesh(hierarchy);
  Rbmt<3>::Vertices added{{1, 1, 1}};
  mesh.split({0, 2, 2}, added);
  EXPECT_TRUE(added.empty());
}

}  // namespace
}  // namespace isostar
