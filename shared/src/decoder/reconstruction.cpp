// The dimension of a header becomes a template parameter. The page's decoder has volumes_only.cpp
// instead.
#include "decoder/reconstruction.h"

namespace isostar {

std::unique_ptr<Reconstruction> reconstructionOf(const Header& header, const Limits& limits,
                                                 const RunTasks& runTasks) {
  switch (header.dimension) {
    case 2:
      return reconstructionIn<2>(header, limits, runTasks);
    case 3:
      return reconstructionIn<3>(header, limits, runTasks);
    case 4:
      return reconstructionIn<4>(header, limits, runTasks);
    default:
      return nullptr;
  }
}

}  // namespace isostar
