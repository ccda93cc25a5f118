#pragma once

#include <cmath>
#include <vector>

#include "bisection/linear_function.h"

namespace isostar::bench {

/// Samples of a function that is linear on the crossing leaves of a mesh and has a constant sign in
/// each region between them.
class LeafField {
 public:
  explicit LeafField(const Hierarchy<3>& hierarchy)
      : hierarchy_(hierarchy), samples_(Lattice<3>(hierarchy.box(), 1).vertices(), NAN) {}

  /// values(sample) returns the value at a vertex of the leaf.
  template <class Values>
  void add(const TaggedSimplex<3>& leaf, Values values) {
    const LinearFunction<3> linear(hierarchy_, leaf,
                                   [&](const auto& v) { return values(hierarchy_.position(v)); });
    fill(leaf, linear);
  }
  /// Propagates signs to the samples outside all crossing leaves; `positive` is the sign if there
  /// are no such leaves.
  void complete(bool positive);

  [[nodiscard]] std::vector<float> take() { return std::move(samples_); }

 private:
  [[nodiscard]] size_t index(const Coordinates<3>& v) const {
    const auto& box = hierarchy_.box();
    return (static_cast<size_t>(v[2]) * static_cast<size_t>(box[1] + 1) +
            static_cast<size_t>(v[1])) *
               static_cast<size_t>(box[0] + 1) +
           static_cast<size_t>(v[0]);
  }
  void fill(const TaggedSimplex<3>& s, const LinearFunction<3>& linear);

  Hierarchy<3> hierarchy_;
  std::vector<float> samples_;  // NaN: unknown
};

}  // namespace isostar::bench
