// Replaces vtk_image.cpp in builds without VTK.
#include "files/failure.h"
#include "volume/volume_formats.h"

namespace isostar::native {

LoadedVolume readVtkImage(const VolumeRequest& request) {
  throw Failure(request.path,
                "this build of isostar reads no VTK files (it was built without VTK)");
}

}  // namespace isostar::native
