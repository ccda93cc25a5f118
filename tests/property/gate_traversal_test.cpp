// An adapted mesh told through its gates is the same on the other side (§5.1, adaptive).
#include "coding/adaptive/gate_traversal.h"

#include "bisection/adaptation.h"
#include "rbmt_checks.h"
#include "sampled_shapes.h"

namespace isostar {
namespace {

template <class Dimension>
class GateTraversalTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(GateTraversalTest, Dimensions);

/// Leaves by their vertices: level and signs.
template <int D>
struct Leaves {
  std::map<Points<D>, std::pair<int, std::vector<bool>>> all;

  template <class Positive>
  void add(const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& leaf, Positive positive) {
    std::vector<bool> signs;
    for (const auto& p : pointsOf(hierarchy, leaf)) signs.push_back(positive(p));
    EXPECT_TRUE(all.insert({pointsOf(hierarchy, leaf), {leaf.depth, signs}}).second)
        << "told twice";
  }
  friend bool operator==(const Leaves&, const Leaves&) = default;
};

template <int D>
Leaves<D> crossingLeaves(const Rbmt<D>& mesh, const Signs<D>& signs) {
  Leaves<D> leaves;
  for (const auto& leaf : tubeOf(mesh, signs))
    leaves.add(mesh.hierarchy(), leaf, [&](const auto& p) { return signs.at(p); });
  return leaves;
}

template <int D>
std::vector<std::byte> coded(const Rbmt<D>& mesh, const Signs<D>& signs) {
  std::vector<std::byte> bytes;
  RangeEncoder coder(bytes);
  MeshEncoderSide<D, RangeEncoder> exchange(coder, mesh, signs);
  Leaves<D> tube;
  GateTraversal<D> traversal(mesh.hierarchy());
  traversal.code(exchange, [&](const auto& leaf, const auto* from, int newVertex) {
    tube.add(mesh.hierarchy(), leaf, [&](const auto& p) { return traversal.positive(p); });
    if (from == nullptr) return;
    EXPECT_LE(std::abs(leaf.depth - from->depth), 1);
    for (int i = 0; i <= D; ++i) EXPECT_EQ(from->has(leaf.vertices[i]), i != newVertex);
  });
  coder.finish();
  EXPECT_TRUE(tube == crossingLeaves(mesh, signs)) << "what is told";
  return bytes;
}

template <int D>
void expectRoundTrip(const Rbmt<D>& mesh, const Signs<D>& signs) {
  const auto bytes = coded(mesh, signs);
  RangeDecoder coder(bytes);
  MeshDecoderSide<D> exchange(coder, 8);
  GateTraversal<D> traversal(mesh.hierarchy());
  Leaves<D> tube;
  traversal.code(exchange, [&](const auto& leaf, const auto*, int) {
    tube.add(mesh.hierarchy(), leaf, [&](const auto& p) { return traversal.positive(p); });
  });
  EXPECT_TRUE(tube == crossingLeaves(mesh, signs)) << "what is heard";
  if (tube.all.empty()) {
    EXPECT_EQ(traversal.positive({}), signs.at({}));
  }
  expectConformingAndRegular(traversal.mesh());
  for (const auto& leaf : leavesOf(traversal.mesh()))
    tube.all.erase(pointsOf(mesh.hierarchy(), leaf));
  EXPECT_TRUE(tube.all.empty()) << "all are leaves of the mesh decoded";
}

template <int D>
Signs<D> diceSigns(const Coordinates<D>& box, unsigned positivesOfSixteen, std::mt19937& dice) {
  Signs<D> signs(Lattice<D>(box, 1));
  for (Coordinates<D> v{};;) {
    signs.set(v, dice() % 16 < positivesOfSixteen);
    int a = 0;
    for (; a < D && ++v[a] > box[a]; ++a) v[a] = 0;
    if (a == D) return signs;
  }
}

TYPED_TEST(GateTraversalTest, anyMeshAndAnySignsComeBack) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
      std::mt19937 dice(seed);
      const Hierarchy<D> hierarchy(box.last, box.finestLevel);
      Rbmt<D> mesh(hierarchy);
      typename Rbmt<D>::Vertices added;
      for (unsigned i = 0; i < 3 * seed * seed; ++i) mesh.split(anyVertex(hierarchy, dice), added);
      for (unsigned positives : {0u, 1u, 8u, 15u, 16u})
        expectRoundTrip(mesh, diceSigns<D>(box.last, positives, dice));
    }
  }
}

TYPED_TEST(GateTraversalTest, theBaseAndTheFullMeshComeBack) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    std::mt19937 dice(7);
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    const auto signs = diceSigns<D>(box.last, 8, dice);
    expectRoundTrip(Rbmt<D>(hierarchy), signs);
    expectRoundTrip(Rbmt<D>::full(hierarchy), signs);
  }
}

TYPED_TEST(GateTraversalTest, aBoxWithoutExtentHasNoLeaves) {
  constexpr int D = TypeParam::value;
  auto last = cube<D>(5);
  last[D - 1] = 0;
  std::mt19937 dice(3);
  expectRoundTrip(Rbmt<D>(Hierarchy<D>(last, 2)), Signs<D>(Lattice<D>(last, 1)));
}

/// Fewer than a bit a vertex and a fraction of a symbol a leaf: the paper's own measure.
TYPED_TEST(GateTraversalTest, aBallAdaptedTakesLessThanThePapersCount) {
  constexpr int D = TypeParam::value;
  const auto ball = sampledBall<D>(D == 4 ? 8 : 29);
  const Hierarchy<D> hierarchy(ball.box, D == 4 ? 2 : 4);
  Rbmt<D> mesh(hierarchy);
  unsigned turn = 0;
  refine(mesh, [&](const TaggedSimplex<D>& s) {
    return !mayCross(ball.signs, hierarchy, s) || (s.depth > 2 * D && ++turn % 5 == 0);
  });
  expectRoundTrip(mesh, ball.signs);
  const auto tube = tubeOf(mesh, ball.signs);
  Points<D> vertices;
  for (const auto& leaf : tube) vertices.merge(pointsOf(hierarchy, leaf));
  EXPECT_LT(8.0 * static_cast<double>(coded(mesh, ball.signs).size()),
            static_cast<double>(vertices.size()) + 1.6 * static_cast<double>(tube.size()) + 64);
}

TYPED_TEST(GateTraversalTest, anyBytesComeToAnEnd) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      std::mt19937 dice(seed);
      std::vector<std::byte> bytes(seed * 3);
      for (auto& b : bytes) b = static_cast<std::byte>(dice());
      RangeDecoder coder(bytes);
      MeshDecoderSide<D> exchange(coder, 8);
      GateTraversal<D> traversal(Hierarchy<D>(box.last, box.finestLevel));
      traversal.code(exchange, [](const auto&, const auto*, int) {});
    }
  }
}

}  // namespace
}  // namespace isostar
