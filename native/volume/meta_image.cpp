#include <itkMetaImageIO.h>

#include "files/text.h"
#include "volume/formats.h"
#include "volume/itk_image.h"

namespace isostar::native {

LoadedVolume readMetaImage(const std::string& path) {
  return readWholeImage(*itk::MetaImageIO::New(), path, extensionOf(path) == ".mha");
}

}  // namespace isostar::native
