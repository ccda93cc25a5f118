// Replaces reconstruction.cpp where the decoder must be small: it supports 3D streams only, since
// each dimension adds as much code again.
#include "decoder/adaptive_reconstruction.h"
#include "decoder/reconstruction.h"
#include "decoder/uniform_reconstruction.h"

namespace isostar {

std::unique_ptr<Reconstruction> reconstructionOf(const Header& header, const Limits& limits) {
  if (header.dimension != 3) return nullptr;
  if (header.adaptive) return std::make_unique<AdaptiveReconstruction<3>>(header, limits);
  return std::make_unique<UniformReconstruction<3>>(header, limits);
}

}  // namespace isostar
