#include "bisection/linear_function.h"

#include <gtest/gtest.h>

#include <random>

#include "bisection/leaves.h"

namespace isostar {
namespace {

/// On each leaf of a mesh: a linear field is its own linear function.
template <int D>
void expectLinearFieldsFound(const Coordinates<D>& box, int finestLevel) {
  std::mt19937 random(D);
  std::uniform_real_distribution<double> any(-3, 3);
  const auto mesh = Rbmt<D>::full(Hierarchy<D>(box, finestLevel));
  const auto& hierarchy = mesh.hierarchy();
  Vector<D> gradient;
  for (double& g : gradient) g = any(random);
  const double origin = any(random);
  const auto field = [&](const Coordinates<D>& position) {
    double value = origin;
    for (int a = 0; a < D; ++a) value += gradient[a] * position[a];
    return value;
  };
  forEachLeaf(mesh, [&](const TaggedSimplex<D>& leaf) {
    const LinearFunction<D> found(
        hierarchy, leaf, [&](const Coordinates<D>& v) { return field(hierarchy.position(v)); });
    for (int a = 0; a < D; ++a) EXPECT_NEAR(found.gradient()[a], gradient[a], 1e-9);
    EXPECT_NEAR(found.steepness(), std::sqrt(dot<D>(gradient, gradient)), 1e-9);
    EXPECT_NEAR(found.at(box), field(box), 1e-9);
    EXPECT_NEAR(found.at({}), origin, 1e-9);
  });
}

TEST(LinearFunction, findsLinearFieldsOnEachLeaf) {
  expectLinearFieldsFound<2>({8, 8}, 2);
  expectLinearFieldsFound<2>({7, 5}, 3);
  expectLinearFieldsFound<3>({4, 3, 6}, 2);
  expectLinearFieldsFound<4>({2, 3, 2, 1}, 1);
}

TEST(LinearFunction, interpolatesTheValuesAtItsVertices) {
  const Hierarchy<3> hierarchy({4, 4, 4}, 2);
  forEachBaseSimplex(hierarchy, Coordinates<3>{}, [&](const TaggedSimplex<3>& s) {
    const auto values = [](const Coordinates<3>& v) { return v[0] * v[1] - 7.0 * v[2] * v[2] + 1; };
    const LinearFunction<3> linear(hierarchy, s, values);
    for (const auto& v : s.vertices) EXPECT_NEAR(linear.at(v), values(v), 1e-9);
  });
}

}  // namespace
}  // namespace isostar
