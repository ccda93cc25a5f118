// Estimates of scalars that are not coded, or not yet, from the signs and from known neighbours;
// for display only.
#pragma once

#include "estimate/dequantization.h"
#include "estimate/hints.h"
#include "estimate/prediction.h"
#include "grid/refined_signs.h"
#include "grid/tube.h"
#include "isostar/isostar.h"
#include "scalars/displacement_window.h"
#include "util/cold_path.h"

namespace isostar {

/// The gradient of bricks where no scalar is known around.
inline constexpr int kPlainGradient = 4 * 12;

/// Gives every vertex of a class in the active bricks a value; known values stay. Values count
/// 2^-finer half quantization steps: where a quantization step is a large part of a grid step,
/// estimates need the precision. `active`: by brick index. `gradient`: as of Scalars, for bricks
/// before the first that has one; without known scalars any value will do, since only ratios are
/// visible.
template <int D>
[[gnu::noinline]] void estimateMissing(const Signs<D>& signs, const std::vector<uint8_t>& active,
                                       Members members, int finer, Scalars<D>& scalars,
                                       const Hints<D>& hints = {}, int gradient = kPlainGradient) {
  // Lower bound of a neighbour's estimate, a third of a grid step: with smaller ones edges would be
  // torn as well.
  constexpr int64_t kShallowest = 2000;
  const Scalars<D> known = scalars;
  Tube<D> tube;
  ScalarWindow<D> window;
  ShapeEstimate<D> shapes(hints.filter);
  DisplacementWindow<D> displaced;
  for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
    if (active[brickIndex] == 0) continue;
    tube.enter(signs, brickIndex, members);
    if (tube.empty()) continue;
    if (known.hasGradient(brickIndex)) gradient = known.gradient(brickIndex);
    window.load(known, tube.table(), tube.at());
    shapes.load(tube.window());
    auto& brick = scalars.writable(brickIndex);
    const SizeUnit unit(gradient + 4 * finer);
    if (hints.displaced()) {
      displaced.load(*hints.displacements, tube.table(), tube.at());
      displaced.spread();
    }
    tube.forEach([&](int row, std::size_t r, int x) {
      const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
      if (brick.knows(v)) return;
      const bool positive = tube.positive(row, x);
      const auto guess =
          Prediction<D>::of(shapes, window, tube, row, r, x, positive, unit, displaced.at(r, x));
      // Next to known scalars, scale the estimate by their ratio to their own estimates. Otherwise
      // an edge between a known and an estimated scalar would be torn.
      const int64_t theirs = std::max<int64_t>(guess.theirs, guess.known * kShallowest);
      const int64_t magnitude = guess.known == 0
                                    ? guess.magnitude
                                    : guess.own * int64_t{guess.other + guess.same} / theirs;
      const auto value = static_cast<int32_t>(
          std::min<int64_t>(std::max(magnitude, unit.steps.eighth()) << unit.shift, INT32_MAX / 2));
      brick.value[v] = positive ? value : -value;
    });
  }
}

/// The same for every vertex that a polygonizer needs.
template <int D>
ISOSTAR_COLD void estimateMissing(const Signs<D>& signs, const std::vector<uint8_t>& active,
                                  Polygonizer polygonizer, int finer, Scalars<D>& scalars,
                                  const Hints<D>& hints) {
  estimateMissing(signs, active, Members::AxisEnds, finer, scalars, hints);
  if (polygonizer == Polygonizer::Tetrahedra)
    estimateMissing(signs, active, Members::DiagonalEnds, finer, scalars, hints);
}

/// Known scalars, with room for estimates between them; dequantized if `smooth`.
template <int D>
struct KnownScalars {
  Scalars<D> scalars;
  int finer;  // values count 2^-finer half quantization steps

  /// `coarser`: on how many coarser levels the same unit is used.
  ISOSTAR_COLD KnownScalars(const BrickTable<D>& table, const Scalars<D>& known, bool smooth,
                            int coarser = 0)
      : scalars(known), finer(scalars.magnify(coarser)) {
    if (smooth) Dequantization<D>::apply(table, known, finer, scalars);
  }
};

/// All scalars that a polygonizer needs: known ones, and estimates for those that are not known.
template <int D>
struct Completed : KnownScalars<D> {
  Completed(const Signs<D>& signs, const std::vector<uint8_t>& active, const Scalars<D>& known,
            Polygonizer polygonizer, const Hints<D>& hints, bool smooth)
      : KnownScalars<D>(signs.table(), known, smooth) {
    estimateMissing(signs, active, polygonizer, this->finer, this->scalars, hints);
  }
};

}  // namespace isostar
