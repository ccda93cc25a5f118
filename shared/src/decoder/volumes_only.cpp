// Replaces reconstruction.cpp where the decoder must be small. Each dimension is a set of template
// instances of its own, so that this build supports 3D streams only.
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
