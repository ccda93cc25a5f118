// Stands in for reconstruction.cpp where the decoder must be small: each dimension would cost a page as much again.
#include "adaptive_reconstruction.h"
#include "reconstruction.h"
#include "reconstruction_in.h"

namespace isostar {

std::unique_ptr<Reconstruction> reconstructionOf(const Header& header, const Limits& limits) {
  if (header.dimension != 3) return nullptr;
  if (header.adaptive) return std::make_unique<AdaptiveReconstruction<3>>(header, limits);
  return std::make_unique<ReconstructionIn<3>>(header, limits);
}

}  // namespace isostar
