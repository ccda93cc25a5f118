// The source as questions: signs on an octave, scalars on the finest (§3, definitions). Only the
// encoder has one.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "coding/exchange/crossing_distortion.h"
#include "container/header.h"
#include "grid/signs.h"
#include "isostar/isostar.h"
#include "scalars/displacements.h"
#include "scalars/scalars.h"

namespace isostar {

/// Is there a surface to ask for? As many samples as the size says, and all finite.
template <int D>
[[nodiscard]] bool sensible(std::span<const float> samples, const Coordinates<D>& size,
                            double isovalue);

/// What samples ask of a quantum.
struct Precision {
  double largest = 0;              // |scalar|; 0 where there is none
  bool ones = true, bytes = true;  // are samples whole numbers, also of 1/255, each on the right
                                   // side of the isovalue?

  /// Adds what another isovalue asks.
  void add(const Precision& other, double apart) {
    largest = std::max(largest, other.largest > 0 ? other.largest + std::abs(apart) : 0);
    ones = ones && other.ones;
    bytes = bytes && other.bytes;
  }
  void fix(Header& header) const;
};

/// Samples on a regular grid, x fastest, borrowed.
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
  /// Along an axis, per sample; of one side where the other is beyond the box.
  [[nodiscard]] double slope(const Coordinates<D>& sample, std::size_t axis) const {
    const std::size_t up = sample[axis] < last_[axis] ? stride_[axis] : 0,
                      down = sample[axis] > 0 ? stride_[axis] : 0, here = at(sample);
    return (double{samples_[here + up]} - double{samples_[here - down]}) *
           (up != 0 && down != 0 ? 0.5 : 1);
  }
  [[nodiscard]] const Coordinates<D>& last() const { return last_; }
  /// Where the edge along an axis between two samples of different signs is crossed, 0 … 1 from
  /// `from` to `to`: one of the places if there are several.
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

  /// Signs on the finest octave, of all samples; coarsened() tells the others.
  [[nodiscard]] Signs<D> signs() const;

  /// What the ends of crossing edges of the RBMT ask of a quantum; `active` as of
  /// activeBricks(signs).
  [[nodiscard]] Precision precision(Polygonizer polygonizer, const Signs<D>& signs,
                                    const std::vector<uint8_t>& active) const;
  /// Fixes what a quantum is for one isovalue alone.
  void quantize(Header& header, const Signs<D>& signs, const std::vector<uint8_t>& active) const {
    precision(header.polygonizer, signs, active).fix(header);
  }

  /// The sample at vertex x in row r of a brick of the finest octave, less the isovalue.
  [[nodiscard]] double scalar(std::size_t brickIndex, std::size_t r, int x) const {
    enter(brickIndex);
    std::size_t sample = lastStart_ + static_cast<std::size_t>(x);
    for (int a = 1; a < D; ++a, r /= kBrickSide) sample += (r % kBrickSide) * stride_[a];
    return double{samples_[sample]} - isovalue_;
  }
  /// The neighbours of vertex x in row r of a brick on each axis, before and ahead, less the
  /// isovalue; beyond the box the vertex itself.
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
  /// In quanta of a header.
  [[nodiscard]] uint32_t magnitude(const Header& header, std::size_t brickIndex, std::size_t r,
                                   int x) const {
    double d = scalar(brickIndex, r, x);
    if (header.quantizationStep != 1) d /= header.quantizationStep;
    if (header.whole)
      return static_cast<uint32_t>(
          (d > 0 ? d - header.positiveOffset : -d - header.negativeOffset) + 0.5);
    return static_cast<uint32_t>(std::min(std::abs(d), double((1 << 29) - 1)));
  }
  /// The median difference along the crossing axis edges in and next to a brick, 4 log2 of quanta.
  /// `signs`: the finest octave's.
  [[nodiscard]] int gradient(const Header& header, const Signs<D>& signs,
                             std::size_t brickIndex) const;

 private:
  [[nodiscard]] std::size_t at(const Coordinates<D>& v) const {
    std::size_t sum = static_cast<std::size_t>(v[0]);
    for (int a = 1; a < D; ++a) sum += static_cast<std::size_t>(v[a]) * stride_[a];
    return sum;
  }
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
  // The brick that was asked of last, its first vertex and sample: bricks are asked one after the
  // other.
  mutable std::size_t lastBrick_ = SIZE_MAX, lastStart_ = 0;
  mutable Coordinates<D> lastFirst_{};
};

/// A sample's distance to the domain's boundary in quanta of a stream, rounded down, as far as it
/// matters.
template <int D>
[[nodiscard]] int32_t domainSteps(const GridField<D>& domain, const Header& header,
                                  std::size_t brickIndex, std::size_t r, int x) {
  const int32_t reach = header.domainReach();
  return static_cast<int32_t>(
      std::clamp(std::floor(domain.scalar(brickIndex, r, x) * header.domainFineness()),
                 double(-reach), double(reach - 1)));
}

/// A field's scalars as the quanta of one stream, and the bricks selected for a pass, by place.
template <int D>
class QuantizedField {
 public:
  /// `domain`: of a trimmed stream.
  QuantizedField(const GridField<D>& field, const Header& header, const Signs<D>& signs,
                 const GridField<D>* domain = nullptr)
      : field_(field), header_(header), signs_(signs), domain_(domain) {}
  void select(std::vector<uint8_t> brickIndices) { selected_ = std::move(brickIndices); }
  /// From now on, does errors() tell of crossings? What is told then need not be true.
  void target(bool does) { rdoq_ = does; }
  /// What a pass of displacements is to tell, in its steps.
  void displace(Displacements<D> steps) { displacements_ = std::move(steps); }
  [[nodiscard]] uint32_t magnitude(std::size_t brickIndex, std::size_t r, int x) const {
    return field_.magnitude(header_, brickIndex, r, x);
  }
  /// As TruthExchange asks for them: by what has been told of the far ends before, and what is
  /// likely to be told of the others.
  template <class CodedAt, class Allowed>
  [[nodiscard]] CrossingDistortion<D> errors(std::size_t brickIndex, std::size_t r, int x,
                                             CodedAt codedAt, const Allowed& allowed) const {
    if (!rdoq_) return {};
    const double toHalfSteps = 2 / header_.quantizationStep,
                 own = field_.scalar(brickIndex, r, x) * toHalfSteps, size = std::abs(own);
    const double positive = 2 * header_.positiveOffset - 1,
                 negative = 2 * header_.negativeOffset - 1, offset = own > 0 ? negative : positive;
    const auto around = field_.around(brickIndex, r, x);
    std::array<double, D> slopes;  // of the normal, squared; steps as long as they are
    double all = std::numeric_limits<double>::min();
    for (std::size_t a = 0; a < D; ++a) {
      const double slope = (around[2 * a + 1] - around[2 * a]) * allowed[std::size_t{1} << a];
      all += slopes[a] = slope * slope;
    }
    CrossingDistortion<D> errors(own > 0 ? positive : negative);
    for (std::size_t i = 0; i < 2 * D; ++i) {
      const double actual = std::abs(around[i]) * toHalfSteps,
                   part = allowed[std::size_t{1} << i / 2] / 65536.0;
      const int32_t coded = codedAt(static_cast<int>(i / 2), i % 2 != 0);
      if (coded == Scalars<D>::kUnknown || (around[i] > 0) == (own > 0) || !(size + actual > 0))
        continue;
      const FarEnd far = i % 2 == 0 ? FarEnd{std::abs(coded) + offset, 1}
                                    : surmised(std::abs(coded), actual, offset, size, part);
      errors.add(
          {size / (size + actual), actual, far.size, 1 / part, slopes[i / 2] / all, far.leaves});
    }
    return errors;
  }
  [[nodiscard]] int gradient(std::size_t brickIndex) const {
    return field_.gradient(header_, signs_, brickIndex);
  }
  [[nodiscard]] int32_t domain(std::size_t brickIndex, std::size_t r, int x) const {
    return domainSteps(*domain_, header_, brickIndex, r, x);
  }
  [[nodiscard]] int displacement(std::size_t brickIndex, std::size_t block) const {
    return displacements_.at(brickIndex)[block];
  }
  [[nodiscard]] bool selected(std::size_t brickIndex) const { return selected_[brickIndex] != 0; }

 private:
  struct FarEnd {
    double size;    // half quanta
    double leaves;  // of what the pass allows
  };
  /// What will be told of a far end that comes later, if halving goes by this edge alone; it will
  /// have an aim of its own.
  [[nodiscard]] static FarEnd surmised(int32_t middle, double actual, double offset, double size,
                                       double part) {
    constexpr double kRoom = 0.8, kTrust = 0.7;  // measured to be best
    double at = middle, width = 2.0 * (middle & -middle);
    const auto moves = [&] {
      return width > 2 && size * width > part * (size + at + offset) * (size + at + offset);
    };
    if (!moves()) return {at + offset, kRoom};
    for (; moves(); width /= 2) at += actual - offset >= at ? width / 4 : -width / 4;
    return {actual + kTrust * (at + offset - actual), kRoom};
  }

  const GridField<D>& field_;
  const Header& header_;
  const Signs<D>& signs_;
  const GridField<D>* domain_;
  std::vector<uint8_t> selected_;
  Displacements<D> displacements_;
  bool rdoq_ = false;
};

}  // namespace isostar
