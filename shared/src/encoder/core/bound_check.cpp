// Measures every vertex of the surface on its edge.
#include "encoder/core/bound_check.h"

#include <algorithm>

#include "encoder/core/coded_crossing.h"

namespace isostar {
namespace {

/// The active bricks that have an edge with an end in a changed brick: edges lead to the next brick
/// on each axis.
template <int D>
std::vector<uint8_t> edgesTo(const std::vector<uint8_t>& changed, const BrickTable<D>& table,
                             const std::vector<uint8_t>& active) {
  std::vector<uint8_t> marked(active.size(), 0);
  for (std::size_t brickIndex = 0; brickIndex < changed.size(); ++brickIndex) {
    if (changed[brickIndex] == 0) continue;
    const auto brick = table.brick(brickIndex);
    auto before = brick;
    for (int32_t& at : before) at = std::max(0, at - 1);
    forEachBetween<D>(before, brick, [&](const Coordinates<D>& from) {
      marked[table.index(from)] = active[table.index(from)];
    });
  }
  return marked;
}

}  // namespace

template <int D>
std::vector<uint8_t> BoundCheck<D>::beyond(double bound, const Signs<D>& signs,
                                           const Scalars<D>& scalars,
                                           const std::vector<uint8_t>& active,
                                           const std::vector<uint8_t>& changed) {
  if (changed.empty()) farthest_.assign(active.size(), 0);
  const auto again = changed.empty() ? active : edgesTo<D>(changed, signs.table(), active);
  std::vector<uint8_t> marked;
  for (const auto& found : ofBrickPieces(again, runTasks_, [&](const BrickRange& range) {
         return measure(bound, signs, scalars, again, range);
       })) {
    if (!found.empty()) marked.resize(active.size(), 0);
    for (const std::size_t brickIndex : found) marked[brickIndex] = 1;
  }
  return marked;
}

/// Measures the marked bricks of a range. Returns the indices of those with an end of an edge that
/// is beyond the bound; some several times.
template <int D>
std::vector<std::size_t> BoundCheck<D>::measure(double bound, const Signs<D>& signs,
                                                const Scalars<D>& scalars,
                                                const std::vector<uint8_t>& marked,
                                                const BrickRange& range) {
  std::vector<std::size_t> found;
  ScalarWindow<D> window;
  double* farthest = nullptr;
  forEachCrossingEdge(
      header_, signs, marked, range,
      [&](std::size_t brickIndex) {
        farthest = &farthest_[brickIndex];
        *farthest = 0;
        window.load(scalars, signs.table(), signs.table().brick(brickIndex));
      },
      [&](const EdgeEnds<D>& ends, double length) {
        const CodedCrossing crossing{
            sizeOf(window.value[static_cast<std::size_t>(ends.evenAt)], header_),
            sizeOf(window.value[static_cast<std::size_t>(ends.oddAt)], header_),
            std::abs(field_.scalar(ends.even)), std::abs(field_.scalar(ends.odd)), length};
        crossing.raise(*farthest);
        if (crossing.isWithin(bound)) return;
        for (const auto& end : {ends.even, ends.odd})
          found.push_back(signs.table().brickIndexOf(end));
      });
  return found;
}

template <int D>
double BoundCheck<D>::largest() const {
  return farthest_.empty() ? 0 : std::ranges::max(farthest_);
}

template class BoundCheck<2>;
template class BoundCheck<3>;
template class BoundCheck<4>;

}  // namespace isostar
