// Stands in for volumes_only.cpp and volume_reconstruction.cpp in the decoder of default streams.
// It is compiled for size, but for what hot_code.h names.
#include "decoder/hot_code.h"
#include "decoder/uniform_reconstruction.h"

namespace isostar {

std::unique_ptr<Reconstruction> reconstructionOf(const Header& header, const Limits& limits,
                                                 const RunTasks& runTasks) {
  if (!header.isDefault()) return nullptr;
  return std::make_unique<UniformReconstruction<3>>(header, limits, runTasks);
}

}  // namespace isostar
