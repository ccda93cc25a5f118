// The decoder's state of an image.
#include "decoder/adaptive_reconstruction.h"
#include "decoder/uniform_reconstruction.h"

namespace isostar {

template <>
std::unique_ptr<Reconstruction> reconstructionIn<2>(const Header& header, const Limits& limits,
                                                    const RunTasks& runTasks) {
  if (header.adaptive) return std::make_unique<AdaptiveReconstruction<2>>(header, limits, runTasks);
  return std::make_unique<UniformReconstruction<2>>(header, limits, runTasks);
}

}  // namespace isostar
