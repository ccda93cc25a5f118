// The surface at an isovalue that is not coded, derived from those that are (§5.4); for display
// only.
#pragma once

#include "coding/isovalues/further_isovalues.h"

namespace isostar {

/// A vertex with a known interval takes the interval's middle. Any other vertex keeps the sign that
/// the isovalues on both sides share. Where those signs differ, the mean of the known neighbours
/// decides, or else the middle between the two isovalues.
template <int D>
class Between {
 public:
  /// `steps`: quantization steps above the first isovalue. `offset`: that of the first isovalue's
  /// positive scalars (Header::positiveOffset).
  Between(const FurtherIsovalues<D>& further, const typename FurtherIsovalues<D>::First& first,
          double isovalue, double steps, double offset)
      : scalars_(further.relativeTo(first, 0)), finer_(scalars_.magnify()), known_(scalars_) {
    const auto neighbours = further.neighbours(first, isovalue);
    const auto& nearest = neighbours.nearest(isovalue);
    signs_ = *nearest.signs;
    // The middle of an interval lies half a quantization step below what Scalars store; this is the
    // offset for all of them.
    const auto inScalars = [&](double isoStep) {
      return std::clamp(std::ldexp(2 * isoStep + 1 - 2 * offset, finer_), -kMost, kMost);
    };
    zero_ = std::llround(inScalars(steps));
    if (neighbours.below && neighbours.above) {
      middle_ = std::llround(
          std::ldexp(double(neighbours.below->isoStep) + neighbours.above->isoStep, finer_));
      below_ = neighbours.below->signs;
      above_ = neighbours.above->signs;
    }
    for (std::size_t brickIndex = 0; brickIndex < scalars_.tableSize(); ++brickIndex)
      brick(brickIndex);
    active_ = activeBricks(signs_);
  }

  /// Bytes needed at most while it is constructed.
  [[nodiscard]] static uint64_t memoryToMake(const FurtherIsovalues<D>& further,
                                             const typename FurtherIsovalues<D>::First& first,
                                             double isovalue) {
    const auto neighbours = further.neighbours(first, isovalue);
    const uint64_t tableSize = first.signs.table().total(), known = further.bricksKnown(first);
    uint64_t bricks = known;
    for (std::size_t brickIndex = 0; neighbours.below && neighbours.above && brickIndex < tableSize;
         ++brickIndex) {
      bricks += splits(*neighbours.below->signs, *neighbours.above->signs, brickIndex) ? 1 : 0;
    }
    return Scalars<D>::memoryOf(tableSize, bricks) + Scalars<D>::memoryOf(tableSize, known) +
           tableSize +
           Signs<D>::memoryToFill(tableSize,
                                  neighbours.nearest(isovalue).signs->brickCount() + bricks);
  }
  /// Bytes in use while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    return scalars_.memory() + known_.memory() + signs_.memory() + active_.size();
  }

  [[nodiscard]] const Signs<D>& signs() const { return signs_; }
  [[nodiscard]] const std::vector<uint8_t>& active() const { return active_; }
  /// Relative to the isovalue, in units of 2^-finer() half quantization steps.
  [[nodiscard]] Scalars<D>& scalars() { return scalars_; }
  [[nodiscard]] int finer() const { return finer_; }

 private:
  static constexpr double kMost = 1 << 30;

  /// May a brick have vertices between two isovalues?
  static bool splits(const Signs<D>& below, const Signs<D>& above, std::size_t brickIndex) {
    return below.slot(brickIndex) != Signs<D>::kNegative &&
           above.slot(brickIndex) != Signs<D>::kPositive;
  }

  void brick(std::size_t brickIndex) {
    const bool split = below_ != nullptr && splits(*below_, *above_, brickIndex);
    if (!split && !known_.has(brickIndex)) return;
    Brick<D> bits = signs_.brickAt(brickIndex);
    const auto& coded = known_.at(brickIndex);
    if (split) window_.load(known_, signs_.table(), signs_.table().brick(brickIndex));
    for (std::size_t r = 0; r < bits.rows.size(); ++r) {
      const unsigned unsure = split ? below_->brickAt(brickIndex).rows[r] &
                                          ~unsigned{above_->brickAt(brickIndex).rows[r]}
                                    : 0;
      for (int x = 0; x < kBrickSide; ++x) {
        const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
        const bool open = (unsure >> x & 1) != 0;
        if (!coded.knows(v) && !open) continue;
        const int64_t value = (coded.knows(v) ? coded.value[v] : around(r, x)) - zero_;
        // Outside the range between the two coded isovalues, the sign is certain.
        const bool sure = below_ != nullptr && !open,
                   positive = sure ? (bits.rows[r] >> x & 1) != 0 : value > 0;
        const auto size =
            static_cast<int32_t>(std::clamp<int64_t>(std::abs(value), 1, INT32_MAX / 2));
        scalars_.writable(brickIndex).value[v] = positive ? size : -size;
        bits.rows[r] = static_cast<uint8_t>((bits.rows[r] & ~(1u << x)) | unsigned{positive} << x);
      }
    }
    if (bits == signs_.brickAt(brickIndex)) return;
    signs_.writable(brickIndex) = bits;
  }

  /// The mean of the known neighbours, or else the middle between both isovalues.
  [[nodiscard]] int64_t around(std::size_t r, int x) const {
    const int32_t* here = &window_.value[ScalarWindow<D>::index(r, x)];
    int64_t sum = 0;
    int count = 0;
    for (int a = 0; a < D; ++a) {
      for (int side = -1; side <= 1; side += 2) {
        const int32_t value = here[side * ScalarWindow<D>::stride(a)];
        if (value == Scalars<D>::kUnknown) continue;
        sum += value;
        ++count;
      }
    }
    return count == 0 ? middle_ : sum / count;
  }

  Scalars<D> scalars_;
  int finer_;
  Scalars<D> known_;  // as coded: relative to the first isovalue
  Signs<D> signs_;
  std::vector<uint8_t> active_;
  int64_t zero_ = 0, middle_ = 0;
  const Signs<D>*below_ = nullptr, *above_ = nullptr;
  ScalarWindow<D> window_;
};

}  // namespace isostar
