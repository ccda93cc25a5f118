// Streams with one changed bit.
#pragma once

#include "harmless.h"
#include "stream_layout.h"

namespace isostar {

/// Calls visit(bytes) for every stride-th bit, with that bit changed.
template <class Visit>
void forEachFlip(const Bytes& bytes, std::size_t stride, Visit visit) {
  Bytes flipped = bytes;
  for (std::size_t bit = 0; bit < bytes.size() * 8; bit += stride) {
    SCOPED_TRACE("bit " + std::to_string(bit % 8) + " of byte " + std::to_string(bit / 8));
    flipped[bit / 8] ^= std::byte{1} << (bit % 8);
    visit(flipped);
    flipped[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

inline void expectHarmlessFlips(const Bytes& good, std::size_t stride = 1) {
  const StreamLayout layout(good);
  forEachFlip(good, stride,
              [&](const Bytes& bytes) { (void)harmlesslyDecoded(repaired(bytes, layout)); });
}

}  // namespace isostar
