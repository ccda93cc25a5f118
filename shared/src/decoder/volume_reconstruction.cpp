// The decoder's state of a volume.
#include "decoder/adaptive_reconstruction.h"
#include "decoder/uniform_reconstruction.h"

namespace isostar {

template <>
std::unique_ptr<Reconstruction> reconstructionIn<3>(const Header& header, const Limits& limits,
                                                    const RunTasks& runTasks) {
  if (header.adaptive) return std::make_unique<AdaptiveReconstruction<3>>(header, limits, runTasks);
  return std::make_unique<UniformReconstruction<3>>(header, limits, runTasks);
}

}  // namespace isostar
