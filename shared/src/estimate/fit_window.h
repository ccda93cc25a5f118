// A brick's scalars as LocalFit needs them: scaled, with weights, and with the curvature of the
// field there.
#pragma once

#include <algorithm>

#include "scalars/scalar_window.h"

namespace isostar {

/// Two opposite neighbours: along one axis, or diagonally across two.
template <int D>
struct Direction {
  int first, second;  // axes; the second is -1 for neighbours along the first
  int side;           // direction along the second axis, ±1; 0 without one
  int offset;         // in a ScalarWindow

  static constexpr std::size_t kCount = std::size_t{D} * D;
  /// The D directions along the axes, then those across each pair of axes.
  static constexpr std::array<Direction, kCount> all() {
    std::array<Direction, kCount> directions{};
    std::size_t n = 0;
    for (int a = 0; a < D; ++a) directions[n++] = {a, -1, 0, ScalarWindow<D>::stride(a)};
    for (int a = 0; a < D; ++a) {
      for (int b = a + 1; b < D; ++b) {
        for (const int side : {1, -1})
          directions[n++] = {a, b, side,
                             ScalarWindow<D>::stride(a) + side * ScalarWindow<D>::stride(b)};
      }
    }
    return directions;
  }
};

/// A brick's scalars with a halo. Values are scaled so that the brick's gradient is 2^kFine.
template <int D>
class FitWindow {
 public:
  static constexpr int kFine = 14;
  static constexpr int32_t kMost = 1 << 18;  // scalars beyond 16 gradients are clamped to it
  using Bends = std::array<int32_t, Direction<D>::kCount>;

  /// Loads the brick in `scalars`. `gradient`: as Scalars store it.
  void load(const ScalarWindow<D>& scalars, int gradient) {
    // A larger value means that no gradient is coded; then nothing is fitted there.
    exponent_ = std::min(gradient / 4, kMostLog2Gradient);
    up_ = kFine - exponent_ - 1;  // scalars are in half quantization steps
    most_ = up_ < 0 ? static_cast<int32_t>(std::min<int64_t>(int64_t{kMost} << -up_, INT32_MAX))
                    : kMost >> up_;
    for (std::size_t i = 0; i < finer_.size(); ++i) {
      const int log2 = exponent_ - 8 + static_cast<int>(i);
      finer_[i] = log2 < 0 ? 0 : int32_t{1} << std::min(log2, 30);
    }
    // Two separate loops, so that the compiler vectorizes each.
    for (std::size_t i = 0; i < value_.size(); ++i) value_[i] = scaled(scalars.value[i]);
    for (std::size_t i = 0; i < weight_.size(); ++i) weight_[i] = weightOf(scalars.value[i]);
    findBends();
  }

  /// Updates the scalar of vertex x in row r after it has been coded.
  void update(std::size_t r, int x, int32_t scalar) {
    const auto at = static_cast<std::size_t>(ScalarWindow<D>::index(r, x));
    value_[at] = scaled(scalar);
    weight_[at] = weightOf(scalar);
  }

  /// log2 of the scale relative to half quantization steps; may be negative.
  [[nodiscard]] int up() const { return up_; }
  /// A value in half quantization steps, in the window's scale.
  [[nodiscard]] int32_t scaled(int32_t scalar) const {
    const int32_t size = std::clamp(scalar, -most_, most_);
    return up_ >= 0 ? size << up_ : size >> -up_;
  }
  /// The value of vertex x in row r, and its neighbours at the offsets of Directions.
  [[nodiscard]] const int32_t* values(std::size_t r, int x) const {
    return &value_[static_cast<std::size_t>(ScalarWindow<D>::index(r, x))];
  }
  /// How well each value is known, 0 … 127; where it is 0 the value has no meaning.
  [[nodiscard]] const uint8_t* weights(std::size_t r, int x) const {
    return &weight_[static_cast<std::size_t>(ScalarWindow<D>::index(r, x))];
  }
  /// By direction: by how much the mean of two opposite neighbours exceeds the value between them,
  /// on average around the vertex.
  [[nodiscard]] const Bends& bends(std::size_t r, int x) const { return bends_[blockOf(r, x)]; }

 private:
  static constexpr int kHalfSide = kBrickSide / 2, kPrior = 12, kMostLog2Gradient = 31;
  static constexpr std::array<int32_t, 8> kLess{
      /// By how much the weight decreases each time the interval's width doubles.
      1, 3, 11, 28, 43, 27, 10, 3};

  /// The block of a vertex; blocks are halves of a brick on each axis.
  static std::size_t blockOf(std::size_t r, int x) {
    std::size_t block = static_cast<std::size_t>(x / kHalfSide);
    for (int a = 1; a < D; ++a, r /= kBrickSide) block |= r % kBrickSide / kHalfSide << a;
    return block;
  }

  /// 127 / (1 + (w/s)²), where w is the standard deviation of the interval, and s, a 40th of a
  /// step, that of the field from a linear one.
  [[nodiscard]] uint8_t weightOf(int32_t scalar) const {
    // The width is the lowest set bit; it is negative for an unknown scalar.
    const auto width =
        static_cast<int32_t>(static_cast<uint32_t>(scalar) & -static_cast<uint32_t>(scalar));
    int32_t weight = 127;
    for (std::size_t i = 0; i < kLess.size(); ++i) weight -= width > finer_[i] ? kLess[i] : 0;
    return static_cast<uint8_t>(width < 0 ? 0 : weight);
  }

  /// Averages second differences by block, each weighted by the least known of its three values;
  /// within a block they are mostly alike.
  void findBends() {
    struct Sum {
      int32_t sum = 0, count = 1;
    };
    std::array<std::array<Sum, Direction<D>::kCount>, std::size_t{1} << D> sums{};
    for (std::size_t r = 0; r < power(kBrickSide, D - 1); ++r) {
      for (int x = 0; x < kBrickSide; ++x) {
        const auto at = static_cast<std::size_t>(ScalarWindow<D>::index(r, x));
        if (weight_[at] == 0) continue;
        auto& sum = sums[blockOf(r, x)];
        for (std::size_t d = 0; d < kDirections.size(); ++d) {
          const std::size_t after = at + static_cast<std::size_t>(kDirections[d].offset),
                            before = at - static_cast<std::size_t>(kDirections[d].offset);
          const int32_t least = std::min({weight_[at], weight_[after], weight_[before]});
          const int32_t weight = least == 0 ? 0 : 1 + least / 4;
          sum[d].sum += ((value_[after] + value_[before]) / 2 - value_[at]) * weight;
          sum[d].count += weight;
        }
      }
    }
    for (std::size_t d = 0; d < kDirections.size(); ++d) {
      int64_t sum = 0, count = 0;
      for (const auto& block : sums) sum += block[d].sum, count += block[d].count;
      const auto mean = static_cast<int32_t>(sum / count);
      for (std::size_t b = 0; b < sums.size(); ++b)
        bends_[b][d] = (sums[b][d].sum + kPrior * mean) / (sums[b][d].count + kPrior);
    }
  }

  static constexpr auto kDirections = Direction<D>::all();

  int exponent_ = 0, up_ = 0;
  int32_t most_ = 0;
  std::array<int32_t, power(kBrickSide + 2, D)> value_;
  std::array<uint8_t, power(kBrickSide + 2, D)> weight_;
  std::array<int32_t, 8> finer_{};
  std::array<Bends, std::size_t{1} << D> bends_;
};

}  // namespace isostar
