// Scalars where none have been told (yet): estimated from the signs and from known neighbours, for
// display only.
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

/// Gives every vertex of a class in the active bricks a value; known ones stay. Values count
/// 2^-finer half quanta: where a quantum is a large part of a step, estimates need more.
template <int D>
[[gnu::noinline]] void estimateMissing(const Signs<D>& signs, const std::vector<uint8_t>& active,
                                       Members members, int finer, Scalars<D>& scalars,
                                       const Hints<D>& hints = {}) {
  constexpr int64_t kShallowest =
      2000;  // of a neighbour's estimate: a third of a step; nearer ones would tear as well
  constexpr int kPlainGradient =
      4 * 12;  // where nothing has been told: any will do, only ratios show
  const Scalars<D> known = scalars;
  Tube<D> tube;
  ScalarWindow<D> window;
  ShapeEstimate<D> shapes(hints.filter);
  DisplacementWindow<D> displaced;
  int gradient = kPlainGradient;
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
      // Beside known scalars in their ratio to what signs and displacements say of them, or an edge
      // between both would be torn.
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

/// All scalars that a polygonizer needs, those that are not known being estimated, and those that
/// are known smoothed if asked for.
template <int D>
struct Completed {
  Scalars<D> scalars;
  int finer;  // values count 2^-finer half quanta

  Completed(const Signs<D>& signs, const std::vector<uint8_t>& active, const Scalars<D>& known,
            Polygonizer polygonizer, const Hints<D>& hints, bool smooth)
      : scalars(known), finer(scalars.magnify()) {
    if (smooth) Dequantization<D>::apply(signs.table(), known, finer, scalars);
    estimateMissing(signs, active, polygonizer, finer, scalars, hints);
  }
};

}  // namespace isostar
