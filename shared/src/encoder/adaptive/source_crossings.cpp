// Finds the vertices of the source's surface.
#include "encoder/adaptive/source_crossings.h"

#include <cmath>

#include "scalars/crossings.h"

namespace isostar {

template <int D>
std::vector<SourceCrossing<D>> findCrossings(const GridField<D>& field,
                                             const typename SourceCrossing<D>::Point& unit,
                                             const Signs<D>& finest) {
  std::vector<SourceCrossing<D>> crossings;
  forCrossedRows(
      finest, activeBricks(finest), false, [](std::size_t) {},
      [&](const Coordinates<D>& brick, unsigned r, unsigned axes, uint32_t crossed) {
        const int axis = std::countr_zero(axes);
        for (; crossed != 0; crossed &= crossed - 1) {
          const EdgeEnds<D> ends(brick, r, static_cast<unsigned>(std::countr_zero(crossed)), axes);
          SourceCrossing<D> c{ends.even, axis, 0, {}, {}, 0};
          Coordinates<D> to = ends.odd;
          if (to[axis] < c.from[axis]) std::swap(c.from, to);
          const double low = std::abs(field.scalar(c.from)), high = std::abs(field.scalar(to));
          c.at = low / (low + high);
          for (int a = 0; a < D; ++a) {
            c.position[a] = c.from[a] + (a == axis ? c.at : 0);
            const auto along = static_cast<std::size_t>(a);
            const double slope =
                a == axis ? field.scalar(to) - field.scalar(c.from)
                          : (1 - c.at) * field.slope(c.from, along) + c.at * field.slope(to, along);
            c.normal[a] = slope / unit[a];
            c.gradient += c.normal[a] * c.normal[a];
          }
          c.gradient = std::sqrt(c.gradient);
          for (double& n : c.normal) n /= c.gradient;
          crossings.push_back(c);
        }
      });
  return crossings;
}

template std::vector<SourceCrossing<2>> findCrossings(const GridField<2>&,
                                                      const SourceCrossing<2>::Point&,
                                                      const Signs<2>&);
template std::vector<SourceCrossing<3>> findCrossings(const GridField<3>&,
                                                      const SourceCrossing<3>::Point&,
                                                      const Signs<3>&);

}  // namespace isostar
