// Stands in for reconstruction.cpp where the decoder must be small: each further dimension would
// cost a page as much again.
#include "decoder/reconstruction.h"

namespace isostar {

std::unique_ptr<Reconstruction> reconstructionOf(const Header& header, const Limits& limits,
                                                 const RunTasks& runTasks) {
  return header.dimension == 3 ? reconstructionIn<3>(header, limits, runTasks) : nullptr;
}

}  // namespace isostar
