// A file of samples without a header, x fastest, little endian. The command line gives size and
// type.
#include <algorithm>
#include <cstring>
#include <fstream>

#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "volume/volume_formats.h"

namespace isostar::native {

LoadedVolume readRaw(const VolumeRequest& request) {
  const uint64_t length = fileSize(request.path);
  SampleBuffer buffer(request.path, *request.size, *request.type, std::max<uint64_t>(length, 1));
  if (buffer.bytes() != length)
    throw Failure(request.path, text("has %llu bytes, but --size and --type require %zu",
                                     static_cast<unsigned long long>(length), buffer.bytes()));
  std::ifstream file(request.path, std::ios::binary);
  file.read(reinterpret_cast<char*>(buffer.data()), static_cast<std::streamsize>(buffer.bytes()));
  if (!file.is_open() || file.bad())
    throw Failure(request.path, text("cannot be read: %s", std::strerror(errno)));
  if (!file)
    throw Failure(request.path,
                  text("was cut from %zu to %llu bytes while it was read", buffer.bytes(),
                       static_cast<unsigned long long>(file.gcount())));
  LoadedVolume volume;
  volume.size = buffer.size();
  volume.samples = buffer.take();
  return volume;
}

}  // namespace isostar::native
