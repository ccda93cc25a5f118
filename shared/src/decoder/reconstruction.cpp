// Selects the reconstruction for a header: uniform or adaptive, by dimension.
#include "decoder/reconstruction.h"

#include "decoder/adaptive_reconstruction.h"
#include "decoder/uniform_reconstruction.h"

namespace isostar {

std::unique_ptr<Reconstruction> reconstructionOf(const Header& header, const Limits& limits) {
  if (header.adaptive) {
    if (header.dimension == 2) return std::make_unique<AdaptiveReconstruction<2>>(header, limits);
    if (header.dimension == 3) return std::make_unique<AdaptiveReconstruction<3>>(header, limits);
    return nullptr;
  }
  switch (header.dimension) {
    case 2:
      return std::make_unique<UniformReconstruction<2>>(header, limits);
    case 3:
      return std::make_unique<UniformReconstruction<3>>(header, limits);
    case 4:
      return header.keepsTopology ? nullptr
                                  : std::make_unique<UniformReconstruction<4>>(header, limits);
    default:
      return nullptr;
  }
}

}  // namespace isostar
