// The fields that all heads of layers have: kind, level and error.
#pragma once

#include "container/stream.h"

namespace isostar {

void writeFields(ByteWriter& out, const LayerHead& head);
/// From the two bytes that writeFields() writes. False if the header has no such level.
[[nodiscard]] bool readFields(uint32_t first, uint32_t error, const Header& header, LayerHead& out);

/// Does an entry of the index say how its level is shown? A refinement of one chunk codes it.
[[nodiscard]] inline bool hasFilter(LayerKind kind, uint64_t chunks) {
  return kind == LayerKind::Refinement && chunks > 1;
}

}  // namespace isostar
