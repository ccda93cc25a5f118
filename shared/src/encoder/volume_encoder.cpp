// The isosurface of a volume: three dimensions. A file of its own: each dimension takes a
// compiler a minute.
#include "encoder/grid_encoder.h"

namespace isostar {

Error encode(const Volume& volume, const EncodeOptions& options, std::vector<std::byte>& out,
             EncodeReport* report) {
  return encodeGrid<3>(volume.samples, volume.domain, headerOf(volume), options, out, report);
}

}  // namespace isostar
