// An adaptive mesh that is coded through its gates is decoded unchanged (§5.1).
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

/// Leaves by their vertices: depth and signs.
template <int D>
struct Leaves {
  std::map<Points<D>, std::pair<int, std::vector<bool>>> all;

  template <class Positive>
  void add(const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& leaf, Positive positive) {
    std::vector<bool> signs;
    for (const auto& p : pointsOf(hierarchy, leaf)) signs.push_back(positive(p));
    EXPECT_TRUE(all.insert({pointsOf(hierarchy, leaf), {leaf.depth, signs}}).second)
        << "coded twice";
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
  EXPECT_TRUE(tube == crossingLeaves(mesh, signs)) << "the encoded leaves";
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
  EXPECT_TRUE(tube == crossingLeaves(mesh, signs)) << "the decoded leaves";
  if (tube.all.empty()) {
    EXPECT_EQ(traversal.positive({}), signs.at({}));
  }
  expectConformingAndRegular(traversal.mesh());
  for (const auto& leaf : leavesOf(traversal.mesh()))
    tube.all.erase(pointsOf(mesh.hierarchy(), leaf));
  EXPECT_TRUE(tube.all.empty()) << "all are leaves of the decoded mesh";
}

template <int D>
Signs<D> randomSigns(const Coordinates<D>& box, unsigned positivesOfSixteen, std::mt19937& random) {
  Signs<D> signs(Lattice<D>(box, 1));
  for (Coordinates<D> v{};;) {
    signs.set(v, random() % 16 < positivesOfSixteen);
    int a = 0;
    for (; a < D && ++v[a] > box[a]; ++a) v[a] = 0;
    if (a == D) return signs;
  }
}

TYPED_TEST(GateTraversalTest, anyMeshWithAnySignsRoundTrips) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
      std::mt19937 random(seed);
      const Hierarchy<D> hierarchy(box.last, box.finestLevel);
      Rbmt<D> mesh(hierarchy);
      typename Rbmt<D>::Vertices added;
      for (unsigned i = 0; i < 3 * seed * seed; ++i)
        mesh.split(anyVertex(hierarchy, random), added);
      for (unsigned positives : {0u, 1u, 8u, 15u, 16u})
        expectRoundTrip(mesh, randomSigns<D>(box.last, positives, random));
    }
  }
}

TYPED_TEST(GateTraversalTest, theBaseAndTheFullMeshRoundTrip) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    std::mt19937 random(7);
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    const auto signs = randomSigns<D>(box.last, 8, random);
    expectRoundTrip(Rbmt<D>(hierarchy), signs);
    expectRoundTrip(Rbmt<D>::full(hierarchy), signs);
  }
}

TYPED_TEST(GateTraversalTest, aBoxWithoutExtentHasNoLeaves) {
  constexpr int D = TypeParam::value;
  auto last = cube<D>(5);
  last[D - 1] = 0;
  std::mt19937 random(3);
  expectRoundTrip(Rbmt<D>(Hierarchy<D>(last, 2)), Signs<D>(Lattice<D>(last, 1)));
}

/// Less than one bit per vertex and a fraction of a symbol per leaf, by the paper's measure.
TYPED_TEST(GateTraversalTest, anAdaptedBallTakesLessThanThePapersMeasure) {
  constexpr int D = TypeParam::value;
  const auto ball = sampledBall<D>(D == 4 ? 8 : 29);
  const Hierarchy<D> hierarchy(ball.box, D == 4 ? 2 : 4);
  Rbmt<D> mesh(hierarchy);
  unsigned count = 0;
  refine(mesh, [&](const TaggedSimplex<D>& s) {
    return !mayCross(ball.signs, hierarchy, s) || (s.depth > 2 * D && ++count % 5 == 0);
  });
  expectRoundTrip(mesh, ball.signs);
  const auto tube = tubeOf(mesh, ball.signs);
  Points<D> vertices;
  for (const auto& leaf : tube) vertices.merge(pointsOf(hierarchy, leaf));
  EXPECT_LT(8.0 * static_cast<double>(coded(mesh, ball.signs).size()),
            static_cast<double>(vertices.size()) + 1.6 * static_cast<double>(tube.size()) + 64);
}

TYPED_TEST(GateTraversalTest, decodingOfAnyBytesEnds) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      std::mt19937 random(seed);
      std::vector<std::byte> bytes(seed * 3);
      for (auto& b : bytes) b = static_cast<std::byte>(random());
      RangeDecoder coder(bytes);
      MeshDecoderSide<D> exchange(coder, 8);
      GateTraversal<D> traversal(Hierarchy<D>(box.last, box.finestLevel));
      traversal.code(exchange, [](const auto&, const auto*, int) {});
    }
  }
}

}  // namespace
}  // namespace isostar
