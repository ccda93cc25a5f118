// Halves of intervals by what a local fit says of them: smaller and slower than by pairs of
// neighbours alone.
#pragma once

#include "coding/exchange/exchange.h"
#include "estimate/local_fit.h"
#include "util/cold_path.h"

namespace isostar {

/// Beside the context of the pairs, three by the fit: level, bent, and both.
template <int D>
class FitCoder {
 public:
  ISOSTAR_COLD FitCoder()
      : byLinear_(kFitContexts), byCurved_(kFitContexts), byBoth_(kBothContexts) {
    weights_.fill(Mixer<4>::initialWeights());
  }

  /// A brick's scalars, and its gradient as Scalars keep it.
  void enter(const ScalarWindow<D>& scalars, int gradient) { window_.load(scalars, gradient); }
  /// Fits what is around vertex x in row r.
  void find(std::size_t r, int x, bool positive) {
    fit_ = LocalFit<D>::of(window_, r, x, positive);
  }
  /// Takes over what has been told of it.
  void update(std::size_t r, int x, int32_t scalar) { window_.update(r, x, scalar); }

  /// Does the vertex found last lie in the upper half? `middle` in half quanta, 2^log2Half of these
  /// to each end; `fineness`: of the interval, 0 … 7; `byPairs`: the chance by pairs of neighbours.
  template <class Coder>
  bool upper(Coder& coder, bool actual, uint32_t middle, int log2Half, std::size_t fineness,
             BitModel& byPairs) {
    const std::size_t linear = ratioOf(fit_.linear, middle, log2Half),
                      curved = ratioOf(fit_.curved, middle, log2Half);
    const std::size_t counted =
        fineness * kCounts + static_cast<std::size_t>(std::min(fit_.known / 3, kCounts - 1));
    const std::array<BitModel*, 4> contexts{
        &byPairs, &byLinear_[counted * kRatios + linear], &byCurved_[counted * kRatios + curved],
        &byBoth_[(fineness * (kRatios / 2) + linear / 2) * (kRatios / 2) + curved / 2]};
    return Mixer<4>::template bit<255, 10>(coder, actual, contexts, weights_[counted]);
  }

 private:
  static constexpr int kRatios = 64, kFinenesses = 8, kCounts = 8;
  static constexpr std::size_t kFitContexts = kFinenesses * kCounts * kRatios;
  static constexpr std::size_t kBothContexts = kFinenesses * (kRatios / 2) * (kRatios / 2);

  /// Where a guess lies in the interval, in eighths of its half: from 1, the middle being 32; 0
  /// without a fit.
  [[nodiscard]] std::size_t ratioOf(int32_t guess, uint32_t middle, int log2Half) const {
    if (fit_.known == 0) return 0;
    const int64_t offset = int64_t{guess} - window_.scaled(static_cast<int32_t>(middle));
    const int log2 = std::max(log2Half + window_.up(), 0);  // of the half, scaled
    const int64_t eighths = log2 >= 3 ? offset >> (log2 - 3) : offset << (3 - log2);
    return static_cast<std::size_t>(std::clamp<int64_t>(eighths + kRatios / 2, 1, kRatios - 1));
  }

  FitWindow<D> window_;
  LocalFit<D> fit_;  // of the vertex in work
  std::vector<BitModel> byLinear_, byCurved_, byBoth_;
  std::array<Mixer<4>::Weights, kFinenesses * kCounts> weights_;
};

}  // namespace isostar
