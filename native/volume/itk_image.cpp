#include "volume/itk_image.h"

#include <itkImageIOBase.h>

#include <cstring>

#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "volume/placement.h"

namespace isostar::native {
namespace {

/// ITK's message without class names and addresses ("itk::ERROR: NrrdImageIO(0x55d0): message") and
/// without NrrdIO's call stack ("[nrrd] nrrdLoad: trouble [nrrd] nrrdRead: message").
std::string plainMessage(const itk::ExceptionObject& error) {
  std::string message = oneLine(error.GetDescription());
  for (const char* before : {"): ", "[nrrd] "}) {
    const size_t at = message.rfind(before);
    if (at != std::string::npos) message.erase(0, at + std::strlen(before));
  }
  return message;
}

SampleType sampleType(const itk::ImageIOBase& io, const std::string& path) {
  using Component = itk::IOComponentEnum;
  const size_t bytes = io.GetComponentSize();
  switch (io.GetComponentType()) {
    case Component::UCHAR:
      return SampleType::U8;
    case Component::CHAR:
      return SampleType::I8;
    case Component::USHORT:
      return SampleType::U16;
    case Component::SHORT:
      return SampleType::I16;
    case Component::UINT:
    case Component::ULONG:
    case Component::ULONGLONG:
      return bytes == 4 ? SampleType::U32 : SampleType::U64;
    case Component::INT:
    case Component::LONG:
    case Component::LONGLONG:
      return bytes == 4 ? SampleType::I32 : SampleType::I64;
    case Component::FLOAT:
      return SampleType::F32;
    case Component::DOUBLE:
      return SampleType::F64;
    default:
      throw Failure(path, "has samples of an unsupported type");
  }
}

/// The fourth axis is time. Further axes must have length 1.
void requirePlain(const itk::ImageIOBase& io, const std::string& path, unsigned mostComponents) {
  const unsigned components = io.GetNumberOfComponents();
  if (components < 1 || components > mostComponents)
    throw Failure(path, text("has %u values per sample; one is needed", components));
  for (unsigned axis = 4; axis < io.GetNumberOfDimensions(); ++axis) {
    if (io.GetDimensions(axis) != 1)
      throw Failure(path, text("has %u dimensions; at most four are read, the fourth being time",
                               io.GetNumberOfDimensions()));
  }
}

Placement placementIn(const itk::ImageIOBase& io, const std::string& path) {
  const unsigned dimensions = std::min(3u, io.GetNumberOfDimensions());
  std::array<double, 3> origin{};
  AxisSteps steps{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (unsigned axis = 0; axis < dimensions; ++axis) {
    const std::vector<double> direction = io.GetDirection(axis);
    origin[axis] = io.GetOrigin(axis);
    for (unsigned row = 0; row < dimensions; ++row)
      steps[axis][row] = direction[row] * io.GetSpacing(axis);
  }
  return placementOf(path, origin, steps);
}

}  // namespace

void quietItk() {
  itk::Object::GlobalWarningDisplayOff();
}

ItkHeader readHeader(itk::ImageIOBase& io, const std::string& path, unsigned mostComponents) {
  quietItk();
  fileSize(path);
  try {
    io.SetFileName(path);
    if (!io.CanReadFile(path.c_str()))
      throw Failure(path, "is not of the format that its extension names");
    io.ReadImageInformation();
  } catch (const itk::ExceptionObject& error) {
    throw Failure(path, plainMessage(error));
  }
  requirePlain(io, path, mostComponents);
  ItkHeader header{.type = sampleType(io, path), .placement = placementIn(io, path)};
  for (unsigned axis = 0; axis < std::min(3u, io.GetNumberOfDimensions()); ++axis)
    header.size[axis] = static_cast<int64_t>(io.GetDimensions(axis));
  if (io.GetNumberOfDimensions() > 3) header.frames = static_cast<int64_t>(io.GetDimensions(3));
  header.dimension = header.frames != 1 ? 4 : io.GetNumberOfDimensions() == 2 ? 2 : 3;
  return header;
}

SampleBuffer bufferFor(const std::string& path, const ItkHeader& header, uint64_t fileBytes) {
  ClaimedSize stacked = header.size;
  if (header.frames < 1 || header.frames > INT32_MAX || stacked[2] > INT32_MAX / header.frames)
    throw Failure(path, text("%lld frames are impossible", static_cast<long long>(header.frames)));
  stacked[2] *= header.frames;
  return SampleBuffer(path, stacked, header.type, fileBytes);
}

void readSamples(itk::ImageIOBase& io, const std::string& path, std::byte* to) {
  const unsigned dimensions = io.GetNumberOfDimensions();
  itk::ImageIORegion whole(dimensions);
  for (unsigned axis = 0; axis < dimensions; ++axis) {
    whole.SetIndex(axis, 0);
    whole.SetSize(axis, io.GetDimensions(axis));
  }
  io.SetIORegion(whole);
  try {
    io.Read(to);
  } catch (const itk::ExceptionObject& error) {
    throw Failure(path, plainMessage(error));
  }
}

LoadedVolume readWholeImage(itk::ImageIOBase& io, const std::string& path, bool attached) {
  const ItkHeader header = readHeader(io, path);
  SampleBuffer buffer = bufferFor(path, header, attached ? fileSize(path) : 0);
  readSamples(io, path, buffer.data());
  LoadedVolume volume;
  volume.dimension = header.dimension;
  volume.frames = static_cast<int32_t>(header.frames);
  for (size_t axis = 0; axis < 3; ++axis)
    volume.size[axis] = static_cast<int32_t>(header.size[axis]);
  volume.placement = header.placement;
  volume.type = nameOf(header.type);
  volume.samples = buffer.take();
  return volume;
}

}  // namespace isostar::native
