#pragma once

#include <string>

#include "volume/loaded_volume.h"
#include "volume/sample_buffer.h"

namespace itk {
class ImageIOBase;
}

namespace isostar::native {

/// What an ITK reader tells of a file before its samples are read: one sample a point, at most four
/// dimensions.
struct ItkHeader {
  ClaimedSize size{1, 1, 1};
  int64_t frames = 1;  // along the fourth axis
  int dimension = 3;   // 2 for an image, 4 where there are several frames
  SampleType type{};
  Placement placement;
};

/// Silences what ITK would print; every reader calls it first.
void quietItk();

/// Reads the header. Fails with one line on anything that is not one plain scalar image, volume or
/// sequence of volumes.
ItkHeader readHeader(itk::ImageIOBase&, const std::string& path, unsigned mostComponents = 1);

/// Reads the samples behind a header into `to`, which has room for them.
void readSamples(itk::ImageIOBase&, const std::string& path, std::byte* to);

/// All frames of a sequence as one volume, one above the other; the header's size and frames are
/// believed then.
SampleBuffer bufferFor(const std::string& path, const ItkHeader&, uint64_t fileBytes);

/// Header and samples. `attached`: the samples are in the file itself, so that its length bounds
/// their number.
LoadedVolume readWholeImage(itk::ImageIOBase&, const std::string& path, bool attached);

}  // namespace isostar::native
