// The source's samples, queried as signs on the finest level and as scalars (§3). Only the encoder
// has them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "container/header.h"
#include "grid/brick_pieces.h"
#include "grid/chunk.h"
#include "grid/signs.h"
#include "isostar/isostar.h"
#include "scalars/scalars.h"

namespace isostar {

/// Are there as many samples as the size says, all of them finite?
template <int D>
[[nodiscard]] bool sensible(std::span<const float> samples, const Coordinates<D>& size,
                            double isovalue, const RunTasks& runTasks = {});

/// What the samples require of a quantization step.
struct Precision {
  double largest = 0;              // |scalar|; 0 if there are no samples
  bool ones = true, bytes = true;  // are all samples whole numbers, of 1 or of 1/255, each on the
                                   // right side of the isovalue?

  /// Adds the requirements of another isovalue, which lies `apart` from this one.
  void add(Precision other, double apart) {
    if (other.largest > 0) other.largest += std::abs(apart);
    add(other);
  }
  /// Adds those of other samples at the same isovalue.
  void add(const Precision& other) {
    largest = std::max(largest, other.largest);
    ones = ones && other.ones;
    bytes = bytes && other.bytes;
  }
  void fix(Header& header) const;
};

/// Samples on a regular grid, the first axis being the fastest. Samples must outlive it.
template <int D>
class GridField {
 public:
  GridField(std::span<const float> samples, const Coordinates<D>& size, double isovalue)
      : samples_(samples), isovalue_(isovalue) {
    std::size_t stride = 1;
    for (int a = 0; a < D; ++a) {
      last_[a] = size[a] - 1;
      stride_[a] = stride;
      stride *= static_cast<std::size_t>(size[a]);
    }
    table_ = BrickTable<D>(Lattice<D>(last_, 1));
  }

  [[nodiscard]] double scalar(const Coordinates<D>& sample) const {
    return double{samples_[at(sample)]} - isovalue_;
  }
  /// Along an axis, per sample. One-sided at the box's ends.
  [[nodiscard]] double slope(const Coordinates<D>& sample, std::size_t axis) const {
    const std::size_t up = sample[axis] < last_[axis] ? stride_[axis] : 0,
                      down = sample[axis] > 0 ? stride_[axis] : 0, here = at(sample);
    return (double{samples_[here + up]} - double{samples_[here - down]}) *
           (up != 0 && down != 0 ? 0.5 : 1);
  }
  [[nodiscard]] const Coordinates<D>& last() const { return last_; }
  /// Where the edge along an axis between two samples of different signs crosses the surface, 0 … 1
  /// from `from` to `to`. If there are several crossings, one of them.
  [[nodiscard]] double crossing(const Coordinates<D>& from, const Coordinates<D>& to,
                                std::size_t axis) const {
    auto low = from, high = to;
    const bool positive = scalar(from) > 0;
    while (std::abs(high[axis] - low[axis]) > 1) {
      auto middle = low;
      middle[axis] += (high[axis] - low[axis]) / 2;
      ((scalar(middle) > 0) == positive ? low : high) = middle;
    }
    const double at = scalar(low) / (scalar(low) - scalar(high));
    return (low[axis] - from[axis] + at * (high[axis] - low[axis])) / (to[axis] - from[axis]);
  }

  /// The samples of a chunk of the finest level; brick indices are then the chunk's own. The view
  /// ends where the chunk's lattice does.
  [[nodiscard]] GridField viewOf(const Chunk<D>& chunk) const {
    GridField view = *this;
    std::size_t first = 0;
    for (int a = 0; a < D; ++a)
      first += static_cast<std::size_t>(chunk.origin[a] * kBrickSide) * stride_[a];
    view.samples_ = samples_.subspan(first);
    view.last_ = chunk.lattice.last;
    view.table_ = BrickTable<D>(chunk.lattice);
    view.lastBrick_ = SIZE_MAX;
    return view;
  }

  /// The signs of the finest level, of all samples. coarsened() gives those of other levels.
  [[nodiscard]] Signs<D> signs(const RunTasks& runTasks = {}) const;

  /// What the ends of the RBMT's crossing edges require of a quantization step. `active`: as of
  /// activeBricks(signs).
  [[nodiscard]] Precision precision(Polygonizer polygonizer, const Signs<D>& signs,
                                    const std::vector<uint8_t>& active,
                                    const RunTasks& runTasks = {}) const;

  /// The scalar of vertex x in row r of a brick of the finest level.
  [[nodiscard]] double scalar(std::size_t brickIndex, std::size_t r, int x) const {
    enter(brickIndex);
    std::size_t sample = lastStart_ + static_cast<std::size_t>(x);
    for (int a = 1; a < D; ++a, r /= kBrickSide) sample += (r % kBrickSide) * stride_[a];
    return double{samples_[sample]} - isovalue_;
  }
  /// The scalars of the neighbours of vertex x in row r of a brick, on each axis the previous and
  /// the next one. Beyond the box it is the vertex's own scalar.
  [[nodiscard]] std::array<double, 2 * D> around(std::size_t brickIndex, std::size_t r,
                                                 int x) const {
    enter(brickIndex);
    auto v = lastFirst_;
    v[0] += x;
    for (std::size_t a = 1; a < D; ++a, r /= kBrickSide)
      v[a] += static_cast<int32_t>(r % kBrickSide);
    const std::size_t here = at(v);
    std::array<double, 2 * D> scalars;
    for (std::size_t a = 0; a < D; ++a) {
      scalars[2 * a] = double{samples_[here - (v[a] > 0 ? stride_[a] : 0)]} - isovalue_;
      scalars[2 * a + 1] = double{samples_[here + (v[a] < last_[a] ? stride_[a] : 0)]} - isovalue_;
    }
    return scalars;
  }
  /// |scalar| in the header's quantization steps.
  [[nodiscard]] uint32_t magnitude(const Header& header, std::size_t brickIndex, std::size_t r,
                                   int x) const {
    double d = scalar(brickIndex, r, x);
    if (header.quantizationStep != 1) d /= header.quantizationStep;
    if (header.whole)
      return static_cast<uint32_t>(
          (d > 0 ? d - header.positiveOffset : -d - header.negativeOffset) + 0.5);
    return static_cast<uint32_t>(std::min(std::abs(d), Header::kMostMagnitude));
  }
  /// The median difference along the crossing axis edges in and next to a brick: 4 log2 of
  /// quantization steps. `signs`: the finest level's.
  [[nodiscard]] int gradient(const Header& header, const Signs<D>& signs,
                             std::size_t brickIndex) const;

 private:
  [[nodiscard]] std::size_t at(const Coordinates<D>& v) const {
    std::size_t sum = static_cast<std::size_t>(v[0]);
    for (int a = 1; a < D; ++a) sum += static_cast<std::size_t>(v[a]) * stride_[a];
    return sum;
  }
  /// The signs of bricks `first` … `first` + bricks.size() - 1, which are all of a row of bricks
  /// along axis 0.
  void rowSigns(std::size_t first, float threshold, std::span<Brick<D>> bricks) const;
  [[nodiscard]] Precision precisionOf(const BrickRange& range, Polygonizer polygonizer,
                                      const Signs<D>& signs,
                                      const std::vector<uint8_t>& active) const;
  void enter(std::size_t brickIndex) const {
    if (brickIndex == lastBrick_) return;
    lastBrick_ = brickIndex;
    lastFirst_ = vertex(table_.brick(brickIndex), 0);
    lastStart_ = at(lastFirst_);
  }
  /// Vertex x = 0 of a row of a brick.
  [[nodiscard]] static Coordinates<D> vertex(const Coordinates<D>& brick, std::size_t r) {
    Coordinates<D> v;
    v[0] = brick[0] * kBrickSide;
    for (int a = 1; a < D; ++a, r /= kBrickSide)
      v[a] = brick[a] * kBrickSide + static_cast<int32_t>(r % kBrickSide);
    return v;
  }

  std::span<const float> samples_;
  double isovalue_;
  Coordinates<D> last_{};
  std::array<std::size_t, D> stride_{};
  BrickTable<D> table_;
  // The brick of the last query, with its first vertex and sample. Queries come brick by brick.
  mutable std::size_t lastBrick_ = SIZE_MAX, lastStart_ = 0;
  mutable Coordinates<D> lastFirst_{};
};

}  // namespace isostar
