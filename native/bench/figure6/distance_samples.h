#pragma once

#include <cmath>
#include <vector>

#include "grid/signs.h"
#include "isostar/isostar.h"
#include "measure/triangle_tree.h"

namespace isostar::bench {

/// Scalars that replace the samples (§6): the distance of a sample to the source's surface in grid
/// steps, with the sample's sign, computed on demand. At both ends of a crossing edge they are
/// scaled so that the crossing is close to that of the samples.
class DistanceSamples {
 public:
  /// `surface` is the source's, in grid steps; without triangles all distances are minimal. All
  /// arguments must outlive this object.
  DistanceSamples(const Volume& volume, double isovalue, const Signs<3>& signs,
                  const measure::TriangleTree& surface);
  DistanceSamples(const DistanceSamples&) = delete;  // as large as the volume

  double operator()(const Coordinates<3>& sample) const;
  /// The source's scalar.
  [[nodiscard]] double source(const Coordinates<3>& sample) const {
    return double{volume_.samples[index(sample)]} - isovalue_;
  }

 private:
  [[nodiscard]] size_t index(const Coordinates<3>& v) const {
    const auto& size = volume_.size;
    return (static_cast<size_t>(v[2]) * static_cast<size_t>(size[1]) + static_cast<size_t>(v[1])) *
               static_cast<size_t>(size[0]) +
           static_cast<size_t>(v[0]);
  }
  [[nodiscard]] float distance(const Coordinates<3>& sample) const;
  void matchCrossings();

  const Volume& volume_;
  double isovalue_;
  const Signs<3>& signs_;
  const measure::TriangleTree& surface_;
  std::array<double, 3> unit_;
  mutable std::vector<float> known_;  // negative if not yet computed
  mutable uint32_t near_ = 0;
};

}  // namespace isostar::bench
