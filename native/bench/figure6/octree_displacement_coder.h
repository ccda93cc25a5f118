#pragma once

#include <cmath>
#include <vector>

#include "bench/figure6/dual_surface.h"
#include "entropy/models.h"

namespace isostar::bench {

/// Codes displacements along normals bit plane by bit plane: which of them reach the plane's step,
/// the signs of those, and a refinement bit for those that reached an earlier plane's step.
/// Neighbours provide the contexts.
class OctreeDisplacementCoder {
 public:
  explicit OctreeDisplacementCoder(const DualSurface& surface)
      : surface_(surface), known_(surface.vertices()), values_(surface.vertices()) {
    for (auto& w : weights_) w = Mixer<3>::initialWeights();
  }

  /// actual(vertex) is in the surface's unit, clamped to two steps of the first plane. Stops when
  /// exhausted() says that there are no more bytes.
  template <class Coder, class Actual, class Exhausted>
  void code(Coder& coder, int plane, Actual actual, Exhausted exhausted) {
    const double step = stepOf(plane);
    for (auto& k : known_) k.steps *= 2;
    for (size_t v = 0; v < known_.size() && !exhausted(); ++v) {
      Known& known = known_[v];
      const Neighbourhood around = neighbourhoodOf(v, step);
      const double displacement = actual(v);
      const int steps = std::min(static_cast<int>(std::abs(displacement) / step), (2 << plane) - 1);
      const auto bit = [&](Kind kind, bool value, double prediction) {
        const auto bin = static_cast<size_t>(
            std::clamp(static_cast<int>(std::floor(4 * prediction)) + kBins / 2, 0, kBins - 1));
        const auto p = static_cast<size_t>(plane);
        const std::array<BitModel*, 3> contexts{
            &byExpected_[kind][bin][std::min<size_t>(p, 7)],
            &byNeighbours_[kind][around.large][std::min<size_t>(p, 7)],
            &byBoth_[kind][bin][around.large]};
        return Mixer<3>::bit<127, 12>(coder, value, contexts, weights_[kind]);
      };
      if (known.steps == 0) {
        if (bit(kLarge, steps > 0, std::abs(around.expected))) {
          known.steps = 1;
          known.negative = bit(kNegative, displacement < 0, around.expected);
        }
      } else {
        const double along = known.negative ? -around.expected : around.expected;
        known.steps += bit(kHalf, (steps & 1) != 0, along - known.steps - 1) ? 1 : 0;
      }
      values_[v] =
          known.steps == 0 ? 0 : (known.steps + kMiddle) * step * (known.negative ? -1 : 1);
    }
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  /// The step of a bit plane: plane 0 codes which displacements reach it.
  [[nodiscard]] static double stepOf(int plane) { return std::ldexp(0.5, -plane); }

 private:
  enum Kind { kLarge, kNegative, kHalf, kKinds };
  struct Known {
    int steps = 0;
    bool negative = false;
  };
  struct Neighbourhood {
    double expected = 0;  // the mean displacement in steps
    size_t large = 0;     // the fraction of displacements that have reached a step, in quarters
  };

  [[nodiscard]] Neighbourhood neighbourhoodOf(size_t vertex, double step) const {
    double sum = 0;
    size_t count = 0, large = 0;
    surface_.forEachNeighbour(vertex, [&](uint32_t w) {
      sum += values_[w];
      large += known_[w].steps != 0;
      ++count;
    });
    return {.expected = sum / (static_cast<double>(count) * step), .large = 4 * large / count};
  }
  /// The reconstruction point in an interval: small displacements are more frequent than large
  /// ones.
  static constexpr double kMiddle = 0.47;
  static constexpr int kBins = 24;

  const DualSurface& surface_;
  std::vector<Known> known_;
  std::vector<double> values_;
  std::array<std::array<std::array<BitModel, 8>, kBins>, kKinds> byExpected_;
  std::array<std::array<std::array<BitModel, 8>, 5>, kKinds> byNeighbours_;
  std::array<std::array<std::array<BitModel, 5>, kBins>, kKinds> byBoth_;
  std::array<Mixer<3>::Weights, kKinds> weights_;
};

}  // namespace isostar::bench
