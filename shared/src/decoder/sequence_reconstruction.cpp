// The decoder's state of a sequence of volumes: neither adaptive nor of one topology.
#include "decoder/uniform_reconstruction.h"

namespace isostar {

template <>
std::unique_ptr<Reconstruction> reconstructionIn<4>(const Header& header, const Limits& limits,
                                                    const RunTasks& runTasks) {
  if (header.adaptive || header.keepsTopology) return nullptr;
  return std::make_unique<UniformReconstruction<4>>(header, limits, runTasks);
}

}  // namespace isostar
