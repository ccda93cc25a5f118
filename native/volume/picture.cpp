// PNG, JPEG and single-page TIFF as grey images.
#include <itkJPEGImageIO.h>
#include <itkPNGImageIO.h>

#include <cmath>

#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "volume/itk_image.h"
#include "volume/volume_formats.h"

namespace isostar::native {
namespace {

/// The grey value of a sample with 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGBA) components; the
/// luminance (Rec. 709) of colours.
double greyOf(const float* sample, unsigned components) {
  return components < 3 ? sample[0] : 0.2126 * sample[0] + 0.7152 * sample[1] + 0.0722 * sample[2];
}

}  // namespace

LoadedVolume pictureFrom(itk::ImageIOBase& io, const std::string& path) {
  const ItkHeader header = readHeader(io, path, 4);
  const unsigned components = io.GetNumberOfComponents();
  SampleBuffer buffer(path, {header.size[0] * components, header.size[1], 1}, header.type,
                      fileSize(path));
  readSamples(io, path, buffer.data());
  const bool bytes = header.type == SampleType::U8;
  LoadedVolume picture;
  picture.dimension = 2;
  picture.size = {static_cast<int32_t>(header.size[0]), static_cast<int32_t>(header.size[1]), 1};
  picture.samples = buffer.take();
  const size_t count = picture.samples.size() / components;
  for (size_t i = 0; i < count; ++i) {
    const double grey = greyOf(&picture.samples[i * components], components);
    picture.samples[i] = static_cast<float>(bytes ? std::round(grey) / 255 : grey);
  }
  picture.samples.resize(count);
  return picture;
}

LoadedVolume readPng(const VolumeRequest& request) {
  return pictureFrom(*itk::PNGImageIO::New(), request.path);
}

LoadedVolume readJpeg(const VolumeRequest& request) {
  return pictureFrom(*itk::JPEGImageIO::New(), request.path);
}

}  // namespace isostar::native
