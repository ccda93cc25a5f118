#include <itkMetaImageIO.h>

#include "files/failure.h"
#include "files/text.h"
#include "volume/captured_errors.h"
#include "volume/itk_image.h"
#include "volume/volume_formats.h"

namespace isostar::native {

LoadedVolume readMetaImage(const std::string& path) {
  // MetaIO leaves missing samples uninitialized and only prints a warning.
  const CapturedErrors errors;
  LoadedVolume volume = readWholeImage(*itk::MetaImageIO::New(), path, extensionOf(path) == ".mha");
  if (!errors.line().empty()) throw Failure(path, errors.line());
  return volume;
}

}  // namespace isostar::native
