#include "reconstruction.h"

#include "reconstruction_in.h"

namespace isostar {

std::unique_ptr<Reconstruction> reconstructionOf(const Header& header, const Limits& limits) {
  switch (header.dimension) {
    case 2: return std::make_unique<ReconstructionIn<2>>(header, limits);
    case 3: return std::make_unique<ReconstructionIn<3>>(header, limits);
    case 4: return std::make_unique<ReconstructionIn<4>>(header, limits);
    default: return nullptr;
  }
}

}  // namespace isostar
