// TIFF: the pages of one file, or a folder of single slices.
#include <itkTIFFImageIO.h>

#include <algorithm>
#include <cctype>

#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "volume/itk_image.h"
#include "volume/named_files.h"
#include "volume/tiff_pages.h"
#include "volume/volume_formats.h"

namespace isostar::native {
namespace {

/// Runs of digits compare as numbers: "slice9" comes before "slice10".
bool naturallyBefore(const std::string& a, const std::string& b) {
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  for (size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (!isDigit(a[i]) || !isDigit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [&](const std::string& name, size_t& at) {
      const size_t first = std::min(name.find_first_not_of('0', at), name.size());
      for (at = first; at < name.size() && isDigit(name[at]);) ++at;
      return name.substr(first, at - first);
    };
    const std::string left = number(a, i), right = number(b, j);
    if (left != right)
      return left.size() != right.size() ? left.size() < right.size() : left < right;
  }
  return a.size() < b.size();
}

/// TIFF's resolution does not include the distance between slices, and most programs write 72 dots
/// per inch.
void discardPlacement(LoadedVolume& volume) {
  volume.placement = {};
  volume.remarks.push_back(
      "a TIFF has no reliable spacing: 1 x 1 x 1 is assumed; --spacing sets another");
}

}  // namespace

LoadedVolume readTiff(const VolumeRequest& request) {
  const std::string& path = request.path;
  requireEqualPages(path);
  const auto io = itk::TIFFImageIO::New();
  if (readHeader(*io, path, 4).dimension == 2) return pictureFrom(*io, path);
  LoadedVolume volume = readWholeImage(*itk::TIFFImageIO::New(), path, true);
  discardPlacement(volume);
  return volume;
}

bool isPicture(const std::string& path) {
  const std::string extension = extensionOf(path);
  return extension == ".tif" || extension == ".tiff";
}

LoadedVolume readPictureStack(const VolumeRequest& request) {
  const std::string& folder = request.path;
  std::vector<std::string> slices;
  for (const std::string& path : filesIn(folder))
    if (isPicture(path)) slices.push_back(path);
  std::stable_sort(slices.begin(), slices.end(), naturallyBefore);
  const ItkHeader first = readHeader(*itk::TIFFImageIO::New(), slices.front());
  ClaimedSize size = first.size;
  if (size[2] != 1)
    throw Failure(slices.front(), "has several pages; the files of a stack must have one each");
  size[2] = static_cast<int64_t>(slices.size());
  SampleBuffer buffer(folder, size, first.type, 0);
  const size_t sliceBytes = buffer.bytes() / slices.size();
  for (size_t k = 0; k < slices.size(); ++k) {
    const auto io = itk::TIFFImageIO::New();
    const ItkHeader header = readHeader(*io, slices[k]);
    if (header.size != first.size || header.type != first.type)
      throw Failure(slices[k], text("differs from %s in size or type", slices.front().c_str()));
    readSamples(*io, slices[k], buffer.data() + k * sliceBytes);
  }
  LoadedVolume volume;
  volume.size = buffer.size();
  volume.samples = buffer.take();
  discardPlacement(volume);
  return volume;
}

}  // namespace isostar::native
