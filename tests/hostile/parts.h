// A stream decoded in parts: a region of it, and two shares that give each other their results.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "isostar/isostar.h"

namespace isostar {

inline bool isInChunks(std::span<const std::byte> stream) {
  StreamInfo info;
  return inspect(stream, info) == Error::None && info.chunkSide != 0;
}

/// Decodes as far as a stream goes, and reads only what is wanted of it, in pieces of at most
/// `piece` bytes. Returns how many bytes that were.
inline uint64_t readWanted(std::span<const std::byte> stream, Decoder& decoder,
                           uint64_t piece = 1 << 20) {
  uint64_t read = 0;
  for (;;) {
    while (decoder.advance()) {
    }
    const ByteRange next = decoder.wanted();
    const uint64_t end = std::min<uint64_t>({next.begin + piece, next.end, stream.size()});
    if (next.begin >= end) return read;
    decoder.accept(stream.subspan(next.begin, end - next.begin), next.begin);
    read += end - next.begin;
  }
}

/// Decodes about a third of a volume along each axis, from bytes that arrive as they are wanted.
inline Decoder decodedRegion(std::span<const std::byte> stream, const Limits& limits) {
  StreamInfo info;
  Region third{.frame = Frame::Grid};
  if (inspect(stream, info) == Error::None) {
    for (std::size_t a = 0; a < 3; ++a) third.most[a] = info.size[a] / 3.0;
  }
  Decoder decoder(limits);
  static_cast<void>(decoder.setRegion(third));
  readWanted(stream, decoder);
  decoder.finish();
  while (decoder.advance()) {
  }
  return decoder;
}

/// Decodes as far as both shares go.
inline std::array<Decoder, 2> decodedShares(std::span<const std::byte> stream,
                                            const Limits& limits) {
  std::array<Decoder, 2> shares{Decoder(limits), Decoder(limits)};
  for (int i = 0; i < 2; ++i) {
    Decoder& share = shares[static_cast<std::size_t>(i)];
    static_cast<void>(share.setShare({i, 2}));
    share.accept(stream);
    share.finish();
  }
  const auto give = [&] {
    const auto first = shares[0].results(), second = shares[1].results();
    const bool isTaken = shares[0].takeResults(second);
    return shares[1].takeResults(first) && isTaken;
  };
  for (bool goesOn = true; goesOn;) {
    goesOn = false;
    for (Decoder& share : shares) {
      while (share.advance()) goesOn = true;
    }
    goesOn = shares[0].needsOthers() && shares[1].needsOthers() ? give() : false;
  }
  static_cast<void>(give());
  return shares;
}

}  // namespace isostar
