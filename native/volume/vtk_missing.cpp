// Stands in for vtk_image.cpp in builds that found no VTK.
#include "files/failure.h"
#include "volume/formats.h"

namespace isostar::native {

LoadedVolume readVtkImage(const std::string& path) {
  throw Failure(path,
                "this build of isostar reads no VTK files (VTK was not found when it was built)");
}

}  // namespace isostar::native
