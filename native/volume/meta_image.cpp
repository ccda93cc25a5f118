#include <itkMetaImageIO.h>

#include <fstream>
#include <sstream>

#include "files/failure.h"
#include "files/text.h"
#include "volume/captured_errors.h"
#include "volume/chosen_frame.h"
#include "volume/itk_image.h"
#include "volume/volume_formats.h"

namespace isostar::native {
namespace {

constexpr size_t kLongestHead = 65536;
constexpr double kMostDimensions = 10;  // of MetaIO, which allocates by the number before it checks

/// Refuses numbers of dimensions that MetaIO would take for others, or allocate for.
void requireDimensions(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(kLongestHead, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(file.gcount()));
  std::istringstream lines(head.substr(0, head.find("ElementDataFile")));
  for (std::string line; std::getline(lines, line);) {
    const size_t sign = line.find_first_of("=:");
    if (sign == std::string::npos || oneLine(line.substr(0, sign)) != "NDims") continue;
    double count = 0;
    std::istringstream(line.substr(sign + 1)) >> count;
    if (!(count >= 1 && count <= kMostDimensions))
      throw Failure(path, text("claims %.10g dimensions; at most four are read", count));
  }
}

}  // namespace

LoadedVolume readMetaImage(const VolumeRequest& request) {
  const std::string& path = request.path;
  requireDimensions(path);
  // MetaIO leaves missing samples uninitialized and only prints a warning.
  const CapturedErrors errors;
  LoadedVolume volume = readWholeImage(*itk::MetaImageIO::New(), path, extensionOf(path) == ".mha");
  if (!errors.line().empty()) throw Failure(path, errors.line());
  takeFrame(volume, path, request.choices);
  return volume;
}

}  // namespace isostar::native
