// The decoder's state of an image.
#include "decoder/adaptive_reconstruction.h"
#include "decoder/uniform_reconstruction.h"

namespace isostar {

template <>
std::unique_ptr<Reconstruction> reconstructionIn<2>(const Header& header, const Limits& limits) {
  if (header.adaptive) return std::make_unique<AdaptiveReconstruction<2>>(header, limits);
  return std::make_unique<UniformReconstruction<2>>(header, limits);
}

}  // namespace isostar
