// Isocontours of an image (§6): two dimensions. A file of its own: each dimension takes a
// compiler a minute.
#include "encoder/grid_encoder.h"

namespace isostar {

Error encode(const Image& image, const EncodeOptions& options, std::vector<std::byte>& out,
             EncodeReport* report) {
  return encodeGrid<2>(image.samples, {}, headerOf(image), options, out, report);
}

}  // namespace isostar
