#pragma once

#include <string>

#include "volume/loaded_volume.h"
#include "volume/sample_buffer.h"

namespace itk {
class ImageIOBase;
}

namespace isostar::native {

/// What an ITK reader tells of a file before its samples are read: one sample a point, at most three dimensions.
struct ItkHeader {
  ClaimedSize size{1, 1, 1};
  SampleType type{};
  Placement placement;
};

/// Silences what ITK would print; every reader calls it first.
void quietItk();

/// Reads the header. Fails with one line on anything that is not one plain scalar volume.
ItkHeader readHeader(itk::ImageIOBase&, const std::string& path);

/// Reads the samples behind a header into `to`, which has room for them.
void readSamples(itk::ImageIOBase&, const std::string& path, std::byte* to);

/// Header and samples. `attached`: the samples are in the file itself, so that its length bounds their number.
LoadedVolume readWholeImage(itk::ImageIOBase&, const std::string& path, bool attached);

}  // namespace isostar::native
