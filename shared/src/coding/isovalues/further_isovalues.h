// Further isovalues on top of the first (§5.4): the state that encoder and decoder share.
#pragma once

#include <memory>
#include <tuple>

#include "coding/geometry/exponent_coder.h"
#include "coding/isovalues/further_magnitude_coder.h"
#include "coding/isovalues/further_sign_coder.h"
#include "grid/refined_signs.h"

namespace isostar {

/// A further isovalue whose signs are coded, and its scalars as far as they are coded.
template <int D>
struct FurtherSurface {
  double isovalue = 0;
  int32_t isoStep = 0;  // quantization steps above the first isovalue
  Signs<D> signs;
  std::vector<uint8_t> active;  // as of activeBricks(signs)
  Scalars<D> scalars;           // of all vertices with an interval, relative to the isovalue
  std::array<bool, 2> coded{};  // by Members
};

template <int D>
class FurtherIsovalues {
 public:
  /// The first isovalue's surface, as far as it is coded.
  struct First {
    double isovalue;
    const Signs<D>& signs;
    const Scalars<D>& scalars;
  };

  /// A coded surface and its isovalue.
  struct Neighbour {
    double isovalue;
    int32_t isoStep;
    const Signs<D>* signs;
  };
  /// The coded isovalues on both sides of another one. At least one of them exists: the first.
  struct Neighbours {
    std::optional<Neighbour> below, above;
    [[nodiscard]] const Neighbour& nearest(double isovalue) const {
      return !above || (below && isovalue - below->isovalue <= above->isovalue - isovalue) ? *below
                                                                                           : *above;
    }
  };

  [[nodiscard]] const std::vector<FurtherSurface<D>>& surfaces() const { return surfaces_; }
  /// The surface of an isovalue; null if its signs are not coded.
  [[nodiscard]] const FurtherSurface<D>* find(double isovalue) const {
    for (const auto& s : surfaces_) {
      if (s.isovalue == isovalue) return &s;
    }
    return nullptr;
  }

  /// Codes the signs of one more isovalue, `isoStep` quantization steps above the first. `margin`:
  /// by how many steps iso steps and signs may disagree.
  template <CodecExchange<D> Exchange>
  [[gnu::noinline]] void signs(Exchange& exchange, const First& first, double isovalue,
                               int32_t isoStep, int32_t margin) {
    if (surfaces_.empty()) takeOver(first);
    if (!coders_) coders_ = std::make_unique<Coders>();
    FurtherSurface<D> added;
    added.isovalue = isovalue;
    added.isoStep = isoStep;
    typename FurtherSignCoder<D>::Position position;
    position.isoStep = isoStep;
    position.margin = margin;
    const Neighbours beside = neighbours(first, isovalue);
    if (beside.below)
      std::tie(position.below, position.isoStepBelow) =
          std::pair(beside.below->signs, beside.below->isoStep);
    if (beside.above)
      std::tie(position.above, position.isoStepAbove) =
          std::pair(beside.above->signs, beside.above->isoStep);
    added.signs = *beside.nearest(isovalue).signs;
    added.scalars = relativeTo(first, isoStep);
    coders_->signs.code(exchange, position, intervals_, added.signs, added.scalars);
    if (exchange.exhausted()) return;  // some signs are unknown
    added.active = activeBricks(added.signs);
    surfaces_.push_back(std::move(added));
  }

  /// Codes exponents of the vertices without bounds.
  template <CodecExchange<D> Exchange>
  [[gnu::noinline]] void exponents(Exchange& exchange, Members members, int exponentRange) {
    FurtherSurface<D>& last = surfaces_.back();
    coders_->exponents.code(exchange, last.signs, last.scalars, members, exponentRange,
                            last.active);
    for (std::size_t brickIndex = 0; brickIndex < last.active.size(); ++brickIndex) {
      if (last.active[brickIndex] != 0 && last.scalars.has(brickIndex))
        intervals_.add(brickIndex, last.scalars.at(brickIndex), last.isoStep);
    }
    last.coded[static_cast<std::size_t>(members)] = true;
  }

  template <CodecExchange<D> Exchange>
  void magnitudes(Exchange& exchange, const typename FurtherMagnitudeCoder<D>::Pass& pass) {
    FurtherSurface<D>& last = surfaces_.back();
    coders_->magnitudes.code(exchange, last.signs, last.isoStep, intervals_, last.scalars, pass,
                             last.active);
  }

  /// The coded isovalues next to `isovalue` on both sides.
  [[nodiscard]] Neighbours neighbours(const First& first, double isovalue) const {
    Neighbours found;
    const auto consider = [&](const Neighbour& one) {
      if (one.isovalue <= isovalue && (!found.below || one.isovalue > found.below->isovalue))
        found.below = one;
      if (one.isovalue > isovalue && (!found.above || one.isovalue < found.above->isovalue))
        found.above = one;
    };
    consider({first.isovalue, 0, &first.signs});
    for (const auto& s : surfaces_) consider({s.isovalue, s.isoStep, &s.signs});
    return found;
  }

  /// The middles of all intervals relative to an isovalue, with the gradient of the isovalue coded
  /// last in each brick.
  [[nodiscard]] Scalars<D> relativeTo(const First& first, int32_t isoStep) const {
    if (intervals_.tableSize() == 0) return first.scalars;  // no further isovalue has begun
    Scalars<D> scalars(intervals_.tableSize());
    int gradient = 0;
    for (std::size_t brickIndex = 0; brickIndex < intervals_.tableSize(); ++brickIndex) {
      if (!intervals_.has(brickIndex)) continue;
      auto& brick = scalars.writable(brickIndex);
      const auto& known = intervals_.at(brickIndex);
      for (std::size_t v = 0; v < known.size(); ++v) {
        if (known[v].bounded()) brick.value[v] = known[v].value(isoStep);
      }
      if (brickIndex < first.scalars.tableSize() && first.scalars.has(brickIndex))
        gradient = first.scalars.gradient(brickIndex);
      for (const auto& s : surfaces_) {
        if (s.scalars.has(brickIndex)) gradient = s.scalars.gradient(brickIndex);
      }
      scalars.setGradient(brickIndex, gradient);
    }
    return scalars;
  }

  /// Bytes needed at most to begin one more isovalue: intervals, scalars, and signs, of which there
  /// are two copies while they are compacted.
  [[nodiscard]] uint64_t memoryToBegin(const First& first) const {
    const auto& table = first.signs.table();
    const uint64_t tableSize = table.total();
    const bool none = surfaces_.empty();
    const uint64_t known = bricksKnown(first);
    uint64_t most = first.signs.brickCount();
    for (const auto& s : surfaces_) most = std::max<uint64_t>(most, s.signs.brickCount());
    return (none ? Intervals<D>::memoryOf(tableSize, known) : 0) +
           Scalars<D>::memoryOf(tableSize, known) + tableSize +
           2 * Signs<D>::memoryToFill(tableSize, most) +
           VertexFront<D>::memoryToBegin(table, 2 * most);
  }
  /// The same for scalars of vertices without an interval.
  [[nodiscard]] uint64_t memoryToCode() const {
    const auto& active = surfaces_.back().active;
    uint64_t bricks = 0;
    for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex)
      bricks += active[brickIndex] != 0 && !intervals_.has(brickIndex) ? 1 : 0;
    return Scalars<D>::memoryOf(0, bricks) + Intervals<D>::memoryOf(0, bricks);
  }
  /// Bytes in use beside the models while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = memoryOfIntervals();
    for (const auto& s : surfaces_) sum += s.signs.memory() + s.scalars.memory() + s.active.size();
    return sum;
  }
  [[nodiscard]] uint64_t memoryOfIntervals() const { return intervals_.memory(); }
  /// In how many bricks relativeTo() knows something.
  [[nodiscard]] std::size_t bricksKnown(const First& first) const {
    return surfaces_.empty() ? first.scalars.brickCount() : intervals_.brickCount();
  }

 private:
  struct Coders {
    FurtherSignCoder<D> signs;
    ExponentCoder<D> exponents;
    FurtherMagnitudeCoder<D> magnitudes;
  };

  void takeOver(const First& first) {
    intervals_ = Intervals<D>(first.signs.table().total());
    for (std::size_t brickIndex = 0; brickIndex < first.scalars.tableSize(); ++brickIndex) {
      if (first.scalars.has(brickIndex))
        intervals_.add(brickIndex, first.scalars.at(brickIndex), 0);
    }
  }

  std::vector<FurtherSurface<D>> surfaces_;
  Intervals<D> intervals_;
  std::unique_ptr<Coders> coders_;  // allocated on demand: most streams need none
};

}  // namespace isostar
