#pragma once

#include <string>

#include "volume/loaded_volume.h"
#include "volume/sample_buffer.h"

namespace itk {
class ImageIOBase;
}

namespace isostar::native {

/// The header of an image, volume or sequence with one value per sample.
struct ItkHeader {
  ClaimedSize size{1, 1, 1};
  int64_t frames = 1;  // along the fourth axis
  int dimension = 3;   // 2 for an image, 4 for a sequence
  SampleType type{};
  Placement placement;
};

/// Turns off ITK's warnings on standard error. Every reader calls it first.
void quietItk();

/// Reads the header. Throws a Failure if the file is not a scalar image, volume or sequence of
/// volumes; `mostComponents` values per sample are accepted.
ItkHeader readHeader(itk::ImageIOBase&, const std::string& path, unsigned mostComponents = 1);

/// Reads all samples into `to`, which must be large enough for them.
void readSamples(itk::ImageIOBase&, const std::string& path, std::byte* to);

/// A buffer for all frames of a sequence, stacked along the third axis. Validates the header's size
/// and number of frames.
SampleBuffer bufferFor(const std::string& path, const ItkHeader&, uint64_t fileBytes);

/// Header and samples. `attached`: the samples are in this file, so its length limits their number.
LoadedVolume readWholeImage(itk::ImageIOBase&, const std::string& path, bool attached);

}  // namespace isostar::native
