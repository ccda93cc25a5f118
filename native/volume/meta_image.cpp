#include <itkMetaImageIO.h>

#include "files/failure.h"
#include "files/text.h"
#include "volume/caught_words.h"
#include "volume/formats.h"
#include "volume/itk_image.h"

namespace isostar::native {

LoadedVolume readMetaImage(const std::string& path) {
  // MetaIO leaves missing samples as they are and goes on.
  const CaughtWords words;
  LoadedVolume volume = readWholeImage(*itk::MetaImageIO::New(), path, extensionOf(path) == ".mha");
  if (!words.line().empty()) throw Failure(path, words.line());
  return volume;
}

}  // namespace isostar::native
