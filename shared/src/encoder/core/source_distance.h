// How far the surface told so far lies from the source's: what layers' heads state, and what holds
// the bound.
#pragma once

#include "encoder/core/field.h"
#include "estimate/hints.h"
#include "scalars/crossings.h"
#include "scalars/scalars.h"

namespace isostar {

/// Distances in grid steps along the smallest spacing. Those of a sample of the source's vertices
/// stand for all.
template <int D>
class SourceDistance {
 public:
  /// Of the finest octave: its signs, and `active` as of activeBricks(signs).
  SourceDistance(const GridField<D>& field, const Header& header, const Signs<D>& signs,
                 const std::vector<uint8_t>& active);

  /// RMS distance from the source's surface to what `cubes` makes of a coarse octave's signs: what
  /// is missing counts, too. Where there is nothing yet, the diagonal of the box.
  [[nodiscard]] double rms(const Signs<D>& coarse, const Hints<D>& hints) const;
  /// RMS distance of the finest octave's surface; scalars without places stand for none told, and
  /// count 2^-finer half quanta.
  [[nodiscard]] double rms(const Signs<D>& finest, const Scalars<D>& scalars,
                           const Hints<D>& hints = {}, int finer = 0) const;
  /// The bricks that it looks at, by place.
  [[nodiscard]] const std::vector<uint8_t>& tableSize() const { return near_; }

  /// The bricks with an end of an edge on which a vertex of the finest surface is off by more than
  /// a bound, 1 marked, by place; empty if there is none. All scalars are known.
  [[nodiscard]] std::vector<uint8_t> beyond(double bound, const Signs<D>& signs,
                                            const Scalars<D>& scalars,
                                            const std::vector<uint8_t>& active) const;

 private:
  using Point = std::array<double, D>;

  /// A vertex of the source's surface.
  struct Sample {
    std::size_t brickIndex;  // of its edge's first vertex
    int evenAt, oddAt;       // the edge's ends in a ScalarWindow
    double crossing;         // where on the edge it lies, from the even end (0) to the odd one (1)
    double perEdge;          // how far the surface moves as the vertex moves along the whole edge
    Point position, normal;
  };

  [[nodiscard]] double size(int32_t value, double unit = 1) const;
  [[nodiscard]] double decoded(const ScalarWindow<D>& scalars, const Sample& sample,
                               double unit) const;
  [[nodiscard]] Point normal(const EdgeEnds<D>& ends) const;

  const GridField<D>& field_;
  const Header& header_;
  Point unit_;                   // by axis
  std::vector<Sample> samples_;  // by place
  std::vector<uint8_t> near_;    // bricks with ends of the samples' edges, by place
};

/// The length of an edge along a set of axes, in grid steps along the smallest spacing. The fourth
/// axis is time: a frame counts as one step.
[[nodiscard]] double edgeLength(const Placement& placement, unsigned axes);

}  // namespace isostar
