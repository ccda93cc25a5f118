#include <itkNrrdImageIO.h>

#include "files/text.h"
#include "volume/chosen_frame.h"
#include "volume/itk_image.h"
#include "volume/volume_formats.h"

namespace isostar::native {

LoadedVolume readNrrd(const VolumeRequest& request) {
  const std::string& path = request.path;
  LoadedVolume volume =
      readWholeImage(*itk::NrrdImageIO::New(), path, extensionOf(path) == ".nrrd");
  takeFrame(volume, path, request.choices);
  return volume;
}

}  // namespace isostar::native
