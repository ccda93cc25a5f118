// Signs in a plain array: the reference for bricks, windows and refinement levels.
#pragma once

#include <functional>
#include <vector>

#include "grid/signs.h"

namespace isostar {

template <int D, class Visit>
void forVertices(const Lattice<D>& lattice, Visit visit) {
  for (Coordinates<D> v{};;) {
    visit(v);
    int a = 0;
    for (; a < D && ++v[a] > lattice.last[a]; ++a) v[a] = 0;
    if (a == D) return;
  }
}

template <int D>
class DenseSigns {
 public:
  /// `positive` takes sample coordinates.
  using Positive = std::function<bool(const Coordinates<D>&)>;

  DenseSigns(const Lattice<D>& lattice, const Positive& positive)
      : lattice_(lattice), signs_(lattice.vertices()) {
    forVertices(lattice, [&](const Coordinates<D>& v) {
      Coordinates<D> sample;
      for (int a = 0; a < D; ++a) sample[a] = lattice.sample(a, v[a]);
      signs_[index(v)] = positive(sample);
    });
  }
  explicit DenseSigns(const Signs<D>& signs)
      : lattice_(signs.lattice()), signs_(lattice_.vertices()) {
    forVertices(lattice_, [&](const Coordinates<D>& v) { signs_[index(v)] = signs.at(v); });
  }

  [[nodiscard]] const Lattice<D>& lattice() const { return lattice_; }
  [[nodiscard]] bool at(const Coordinates<D>& v) const { return signs_[index(v)]; }
  /// Beyond the lattice: mirrored.
  [[nodiscard]] bool mirroredAt(Coordinates<D> v) const {
    for (int a = 0; a < D; ++a) v[a] = lattice_.mirrored(a, v[a]);
    return at(v);
  }
  [[nodiscard]] Signs<D> bricks() const {
    Signs<D> signs(lattice_);
    forVertices(lattice_, [&](const Coordinates<D>& v) { signs.set(v, at(v)); });
    return signs;
  }
  friend bool operator==(const DenseSigns& a, const DenseSigns& b) { return a.signs_ == b.signs_; }

 private:
  [[nodiscard]] std::size_t index(const Coordinates<D>& v) const {
    std::size_t at = 0;
    for (int a = D - 1; a >= 0; --a)
      at = at * static_cast<std::size_t>(lattice_.last[a] + 1) + static_cast<std::size_t>(v[a]);
    return at;
  }

  Lattice<D> lattice_;
  std::vector<bool> signs_;
};

}  // namespace isostar
