// Four numbers side by side: a vector of the machine, by the extension that GCC and Clang share, so
// that every build has the same source.
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

/// A pair of vectors' lanes, by number: those of the second one from 4 on.
template <int A, int B, int C, int D>
Lanes shuffled(Lanes first, Lanes second) {
  return __builtin_shufflevector(first, second, A, B, C, D);
}

/// The sum of each vector's lanes.
inline Lanes sums(Lanes a, Lanes b, Lanes c, Lanes d) {
  const Lanes ab = shuffled<0, 4, 1, 5>(a, b) + shuffled<2, 6, 3, 7>(a, b),
              cd = shuffled<0, 4, 1, 5>(c, d) + shuffled<2, 6, 3, 7>(c, d);
  return shuffled<0, 1, 4, 5>(ab, cd) + shuffled<2, 3, 6, 7>(ab, cd);
}

inline Lanes smaller(Lanes a, Lanes b) {
  return a < b ? a : b;
}
inline Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}

/// 8 log2 of numbers, roughly; 0 of nothing: a float's upper bits are that. Up to 2^24 all floats
/// are exact.
inline Lanes eighths(Lanes numbers) {
  using Floats [[gnu::vector_size(16)]] = float;
  const Floats floats = __builtin_convertvector(numbers, Floats);
  Lanes bits;
  std::memcpy(&bits, &floats, sizeof bits);
  return larger((bits >> 20) - (127 * 8 - 1), Lanes{});
}

inline Lanes clamped(Lanes value, int32_t bound) {
  value = value < -bound ? Lanes{} - bound : value;
  return value > bound ? Lanes{} + bound : value;
}

}  // namespace isostar
