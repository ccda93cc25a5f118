// Shapes of any dimension as samples of a box, for meshes of the RBMT.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "bisection/leaves.h"
#include "bisection/linear_function.h"

namespace isostar {

/// A function, its samples and their signs.
template <int D>
struct SampledShape {
  Coordinates<D> box{};
  std::function<double(const Vector<D>&)> at;
  std::vector<double> values;
  Signs<D> signs;

  SampledShape(const Coordinates<D>& last, std::function<double(const Vector<D>&)> function)
      : box(last), at(std::move(function)), values(Lattice<D>(last, 1).vertices()) {
    Coordinates<D> v{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      Vector<D> p;
      for (int a = 0; a < D; ++a) p[a] = v[a];
      values[i] = at(p);
      for (int a = 0; a < D && ++v[a] > box[a]; ++a) v[a] = 0;
    }
    updateSigns();
  }
  [[nodiscard]] std::size_t index(const Coordinates<D>& v) const {
    std::size_t brickIndex = 0;
    for (int a = D - 1; a >= 0; --a)
      brickIndex =
          brickIndex * static_cast<std::size_t>(box[a] + 1) + static_cast<std::size_t>(v[a]);
    return brickIndex;
  }
  void updateSigns() {
    signs = Signs<D>(Lattice<D>(box, 1));
    Coordinates<D> v{};
    for (double value : values) {
      signs.set(v, value > 0);
      for (int a = 0; a < D && ++v[a] > box[a]; ++a) v[a] = 0;
    }
  }
  double operator()(const Coordinates<D>& v) const { return values[index(v)]; }
};

template <int D>
Coordinates<D> cube(int32_t last) {
  Coordinates<D> box;
  box.fill(last);
  return box;
}

/// The distance to a sphere slightly off the centre, positive inside.
template <int D>
SampledShape<D> sampledBall(int32_t last) {
  return SampledShape<D>(cube<D>(last), [=](const Vector<D>& p) {
    double squares = 0;
    for (int a = 0; a < D; ++a)
      squares += (p[a] - last * 0.48 - 0.1 * a) * (p[a] - last * 0.48 - 0.1 * a);
    return last * 0.37 - std::sqrt(squares);
  });
}

template <int D>
SampledShape<D> sampledPlane(int32_t last) {
  return SampledShape<D>(cube<D>(last), [=](const Vector<D>& p) {
    double sum = -last * 0.6;
    for (int a = 0; a < D; ++a) sum += p[a] * (0.4 + 0.13 * a);
    return sum;
  });
}

template <int D>
std::vector<TaggedSimplex<D>> tubeOf(const Rbmt<D>& mesh, const Signs<D>& signs) {
  std::vector<TaggedSimplex<D>> tube;
  forEachCrossingLeaf(mesh, signs, [&](const TaggedSimplex<D>& leaf) { tube.push_back(leaf); });
  return tube;
}

/// Where the linear function of a leaf is zero on its edges.
template <int D>
std::vector<Vector<D>> crossingsOf(const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& leaf,
                                   const SampledShape<D>& shape) {
  std::vector<Vector<D>> crossings;
  for (int i = 0; i <= D; ++i) {
    for (int j = i + 1; j <= D; ++j) {
      const auto p = hierarchy.position(leaf.vertices[i]), q = hierarchy.position(leaf.vertices[j]);
      if ((shape(p) > 0) == (shape(q) > 0)) continue;
      Vector<D> x;
      for (int a = 0; a < D; ++a) x[a] = p[a] + (q[a] - p[a]) * shape(p) / (shape(p) - shape(q));
      crossings.push_back(x);
    }
  }
  return crossings;
}

}  // namespace isostar
