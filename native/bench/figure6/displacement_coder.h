#pragma once

#include <cmath>
#include <vector>

#include "bench/figure6/dual_surface.h"
#include "entropy/models.h"

namespace isostar::bench {

/// Displacements along normals, plane of bits after plane: which of them are as large as the
/// plane's step, their signs, and halves of the intervals of those that were before. Neighbours say
/// what to expect.
class DisplacementCoder {
 public:
  explicit DisplacementCoder(const DualSurface& surface)
      : surface_(surface), known_(surface.vertices()), values_(surface.vertices()) {
    for (auto& w : weights_) w = Mixer<3>::initialWeights();
  }

  /// truth(vertex) in the surface's unit; what is farther than two steps of the first plane is told
  /// as that far. Goes no further when spent() says that the bytes are used up.
  template <class Coder, class Actual, class Spent>
  void code(Coder& coder, int plane, Actual actual, Spent exhausted) {
    const double step = stepOf(plane);
    for (auto& k : known_) k.steps *= 2;
    for (size_t v = 0; v < known_.size() && !exhausted(); ++v) {
      Known& known = known_[v];
      double expected = 0;
      size_t count = 0, large = 0;
      surface_.forEachNeighbour(v, [&](uint32_t w) {
        expected += values_[w];
        large += known_[w].steps != 0;
        ++count;
      });
      expected /= static_cast<double>(count) * step;
      large = 4 * large / count;
      const double real = actual(v);
      const int steps = std::min(static_cast<int>(std::abs(real) / step), (2 << plane) - 1);
      const auto bit = [&](Kind kind, bool value, double where) {
        const auto near = static_cast<size_t>(
            std::clamp(static_cast<int>(std::floor(4 * where)) + kNear / 2, 0, kNear - 1));
        const auto p = static_cast<size_t>(plane);
        const std::array<BitModel*, 3> contexts{&byExpected_[kind][near][std::min<size_t>(p, 7)],
                                                &byNeighbours_[kind][large][std::min<size_t>(p, 7)],
                                                &byBoth_[kind][near][large]};
        return Mixer<3>::bit<127, 12>(coder, value, contexts, weights_[kind]);
      };
      if (known.steps == 0) {
        if (bit(kLarge, steps > 0, std::abs(expected))) {
          known.steps = 1;
          known.negative = bit(kNegative, real < 0, expected);
        }
      } else {
        const double along = known.negative ? -expected : expected;
        known.steps += bit(kHalf, (steps & 1) != 0, along - known.steps - 1) ? 1 : 0;
      }
      values_[v] =
          known.steps == 0 ? 0 : (known.steps + kMiddle) * step * (known.negative ? -1 : 1);
    }
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  /// The first plane tells which displacements are at least so large.
  [[nodiscard]] static double stepOf(int plane) { return std::ldexp(0.5, -plane); }

 private:
  enum Kind { kLarge, kNegative, kHalf, kKinds };
  struct Known {
    int steps = 0;
    bool negative = false;
  };
  static constexpr double kMiddle =
      0.47;  // of an interval: small displacements are more frequent than large ones
  static constexpr int kNear = 24;

  const DualSurface& surface_;
  std::vector<Known> known_;
  std::vector<double> values_;
  std::array<std::array<std::array<BitModel, 8>, kNear>, kKinds> byExpected_;
  std::array<std::array<std::array<BitModel, 8>, 5>, kKinds> byNeighbours_;
  std::array<std::array<std::array<BitModel, 5>, kNear>, kKinds> byBoth_;
  std::array<Mixer<3>::Weights, kKinds> weights_;
};

}  // namespace isostar::bench
