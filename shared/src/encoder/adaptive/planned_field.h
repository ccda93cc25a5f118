// The scalars of an adaptive plan, as the encoder's exchange queries them.
#pragma once

#include <cmath>

#include "encoder/adaptive/adaptive_plan.h"
#include "scalars/scalars.h"

namespace isostar {

/// The scalars that a plan has chosen, in quantization steps, on one level at a time.
template <int D>
class PlannedField {
 public:
  PlannedField(const AdaptivePlan<D>& plan, const Header& header) : plan_(plan), header_(header) {}
  void enter(int level, const Signs<D>& signs) {
    level_ = level;
    signs_ = &signs;
  }
  [[nodiscard]] uint32_t magnitude(std::size_t brickIndex, std::size_t r, int x) const {
    return steps(vertexOf<D>(signs_->table().brick(brickIndex),
                             r * kBrickSide + static_cast<std::size_t>(x)));
  }
  /// The mean difference along crossing axis edges: 4 log2 of quantization steps.
  [[nodiscard]] int gradient(std::size_t brickIndex) const {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < Scalars<D>::kVertices; ++i) {
      const auto v = vertexOf<D>(signs_->table().brick(brickIndex), i);
      bool inside = true;
      for (int a = 0; a < D; ++a) inside = inside && v[a] <= signs_->lattice().last[a];
      for (int a = 0; inside && a < D; ++a) {
        auto next = v;
        if (++next[a] > signs_->lattice().last[a] || signs_->at(next) == signs_->at(v)) continue;
        sum += static_cast<double>(steps(v)) + steps(next) + 1;
        ++count;
      }
    }
    return count == 0
               ? 0
               : std::clamp(static_cast<int>(std::lround(4 * std::log2(sum / count))), 0, 4 * 31);
  }
  [[nodiscard]] bool selected(std::size_t) const { return true; }

 private:
  [[nodiscard]] uint32_t steps(const Coordinates<D>& v) const {
    return static_cast<uint32_t>(std::min(
        std::abs(plan_.scalar(level_, v)) / header_.quantizationStep, double((1 << 29) - 1)));
  }

  const AdaptivePlan<D>& plan_;
  const Header& header_;
  int level_ = 0;
  const Signs<D>* signs_ = nullptr;
};

}  // namespace isostar
