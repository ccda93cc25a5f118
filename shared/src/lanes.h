// Four numbers side by side: a vector of the machine, by the extension that GCC and Clang share, so that every build has the same source.
#pragma once

#include <cstdint>
#include <cstring>

namespace isostar {

using Lanes [[gnu::vector_size(16)]] = int32_t;

inline Lanes lanesAt(const int32_t* first) {
  Lanes lanes;
  std::memcpy(&lanes, first, sizeof lanes);
  return lanes;
}

inline Lanes clamped(Lanes value, int32_t bound) {
  value = value < -bound ? Lanes{} - bound : value;
  return value > bound ? Lanes{} + bound : value;
}

}  // namespace isostar
