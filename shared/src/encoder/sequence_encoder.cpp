// The isosurface of a sequence of volumes (§6): four dimensions. A file of its own: each dimension
// takes a compiler a minute.
#include "encoder/grid_encoder.h"

namespace isostar {

Error encode(const Sequence& sequence, const EncodeOptions& options, std::vector<std::byte>& out,
             EncodeReport* report) {
  return encodeGrid<4>(sequence.samples, {}, headerOf(sequence), options, out, report);
}

}  // namespace isostar
