#include <itkNrrdImageIO.h>

#include "files/text.h"
#include "volume/itk_image.h"
#include "volume/volume_formats.h"

namespace isostar::native {

LoadedVolume readNrrd(const std::string& path) {
  return readWholeImage(*itk::NrrdImageIO::New(), path, extensionOf(path) == ".nrrd");
}

}  // namespace isostar::native
