// Where the surface of a volume crosses its edges, computed from the samples: the reference for
// what a stream promises. Only the order of vertices is taken from polygonize().
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "isostar/isostar.h"

namespace isostar {

/// A crossing of an edge of the surface, in grid steps.
struct ExactCrossing {
  std::array<double, 3> position{};
  double positive = 0, negative = 0;  // |scalar| of its ends
};

class ExactSurface {
 public:
  /// `volume` and `samples` must outlive it.
  ExactSurface(const Volume& volume, double isovalue, Polygonizer polygonizer)
      : volume_(volume), isovalue_(isovalue) {
    // Whole numbers of the same signs, different at the ends of each edge: no crossing is in the
    // middle, so that a vertex of a diagonal says which diagonal it lies on.
    std::vector<float> signs(volume.samples.size());
    for (std::size_t i = 0; i < signs.size(); ++i)
      signs[i] = static_cast<float>(scalar(i) > 0 ? weight(i) : -weight(i));
    Volume marked = volume;
    marked.samples = signs;
    Mesh mesh;
    error_ = polygonize(marked, 0, {polygonizer, Frame::Grid, false}, mesh);
    indices_ = mesh.indices;
    for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += 3)
      crossings_.push_back(crossingAt(&mesh.positions[i]));
  }

  [[nodiscard]] Error error() const { return error_; }
  /// The triangles of the surface.
  [[nodiscard]] const std::vector<uint32_t>& indices() const { return indices_; }
  [[nodiscard]] const std::vector<ExactCrossing>& crossings() const { return crossings_; }

 private:
  [[nodiscard]] double scalar(std::size_t sample) const {
    return double{volume_.samples[sample]} - isovalue_;
  }
  [[nodiscard]] std::size_t side(std::size_t axis) const {
    return static_cast<std::size_t>(volume_.size[axis]);
  }
  /// 1 … 15, by the parity of the coordinates.
  [[nodiscard]] int weight(std::size_t sample) const {
    const std::size_t x = sample % side(0), y = sample / side(0) % side(1),
                      z = sample / side(0) / side(1);
    return static_cast<int>(1 + 2 * (x % 2 + 2 * (y % 2) + 4 * (z % 2)));
  }
  [[nodiscard]] std::size_t sampleAt(const std::array<double, 3>& at) const {
    return static_cast<std::size_t>(at[0]) +
           side(0) * (static_cast<std::size_t>(at[1]) + side(1) * static_cast<std::size_t>(at[2]));
  }

  /// Of the edge on which a vertex of the marked volume's surface lies.
  [[nodiscard]] ExactCrossing crossingAt(const float* vertex) const {
    std::array<double, 3> from{}, to{};
    double first = -1;  // the fraction along the first axis on which the ends differ
    for (std::size_t a = 0; a < 3; ++a) {
      const double floor = std::floor(vertex[a]), fraction = vertex[a] - floor;
      from[a] = to[a] = floor;
      if (fraction == 0) continue;
      if (first < 0) first = fraction;
      const bool along = std::abs(fraction - first) < std::abs(1 - fraction - first);
      (along ? to[a] : from[a]) += 1;
    }
    const double low = scalar(sampleAt(from)), high = scalar(sampleAt(to));
    const double share = low / (low - high);
    ExactCrossing crossing{.positive = std::max(low, high), .negative = -std::min(low, high)};
    for (std::size_t a = 0; a < 3; ++a) crossing.position[a] = from[a] + share * (to[a] - from[a]);
    return crossing;
  }

  const Volume& volume_;
  const double isovalue_;
  Error error_ = Error::None;
  std::vector<uint32_t> indices_;
  std::vector<ExactCrossing> crossings_;
};

}  // namespace isostar
