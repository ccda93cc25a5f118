// Codes magnitude refinements in contexts from a local fit: fewer bytes, but slower than pairs of
// neighbours alone.
#pragma once

#include "coding/exchange/exchange.h"
#include "estimate/local_fit.h"
#include "util/cold_path.h"

namespace isostar {

/// Mixes the context of the pairs with three of the fit: linear, curved, and both.
template <int D>
class FitCoder {
 public:
  ISOSTAR_COLD FitCoder()
      : byLinear_(kFitContexts), byCurved_(kFitContexts), byBoth_(kBothContexts) {
    weights_.fill(Mixer<4>::initialWeights());
  }

  /// Bytes beside the object.
  [[nodiscard]] static constexpr uint64_t memoryOfModels() {
    return (2 * kFitContexts + kBothContexts) * sizeof(BitModel);
  }

  /// Loads a brick's scalars. `gradient`: as Scalars store it.
  void enter(const ScalarWindow<D>& scalars, int gradient) { window_.load(scalars, gradient); }
  /// Fits the surroundings of vertex x in row r.
  void find(std::size_t r, int x, bool positive) {
    fit_ = LocalFit<D>::of(window_, r, x, positive);
  }
  /// Stores the refined scalar for later fits.
  void update(std::size_t r, int x, int32_t scalar) { window_.update(r, x, scalar); }

  /// Codes whether the vertex of the last find() lies in the upper half of its interval. `middle`:
  /// in half quantization steps; each half is 2^log2Half of them wide. `fineness`: of the interval,
  /// 0 … 7. `byPairs`: the bit model of the pairs of neighbours.
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

  /// The position of a guess in the interval, in eighths of its half: 1 … 63, where 32 is the
  /// middle; 0 without a fit.
  [[nodiscard]] std::size_t ratioOf(int32_t guess, uint32_t middle, int log2Half) const {
    if (fit_.known == 0) return 0;
    const int64_t offset = int64_t{guess} - window_.scaled(static_cast<int32_t>(middle));
    const int log2 = std::max(log2Half + window_.up(), 0);  // of the scaled half
    const int64_t eighths = log2 >= 3 ? offset >> (log2 - 3) : offset << (3 - log2);
    return static_cast<std::size_t>(std::clamp<int64_t>(eighths + kRatios / 2, 1, kRatios - 1));
  }

  FitWindow<D> window_;
  LocalFit<D> fit_;  // of the current vertex
  std::vector<BitModel> byLinear_, byCurved_, byBoth_;
  std::array<Mixer<4>::Weights, kFinenesses * kCounts> weights_;
};

}  // namespace isostar
