// Vectors of four 32-bit integers, by the vector extension that GCC and Clang share. Every target
// compiles the same source.
#pragma once

#include <cstdint>
#include <cstring>

namespace isostar {

using Lanes [[gnu::vector_size(16)]] = int32_t;

/// Loads four integers; any alignment.
inline Lanes lanesAt(const int32_t* first) {
  Lanes lanes;
  std::memcpy(&lanes, first, sizeof lanes);
  return lanes;
}

/// Selects four lanes of a pair of vectors by number: 0 … 3 are the first one's, 4 … 7 the second
/// one's.
template <int A, int B, int C, int D>
Lanes shuffled(Lanes first, Lanes second) {
  return __builtin_shufflevector(first, second, A, B, C, D);
}

/// Lane i is the sum of the four lanes of the i-th argument.
inline Lanes sums(Lanes a, Lanes b, Lanes c, Lanes d) {
  const Lanes ab = shuffled<0, 4, 1, 5>(a, b) + shuffled<2, 6, 3, 7>(a, b),
              cd = shuffled<0, 4, 1, 5>(c, d) + shuffled<2, 6, 3, 7>(c, d);
  return shuffled<0, 1, 4, 5>(ab, cd) + shuffled<2, 3, 6, 7>(ab, cd);
}

/// The minimum, lane by lane.
inline Lanes smaller(Lanes a, Lanes b) {
  return a < b ? a : b;
}
/// The maximum, lane by lane.
inline Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}

/// About 8 log2(n) + 1 of each lane n > 0, and 0 of 0: the exponent and the upper three bits of the
/// mantissa of n as a float. Floats represent integers up to 2^24 exactly.
inline Lanes log2Eighths(Lanes numbers) {
  using Floats [[gnu::vector_size(16)]] = float;
  const Floats floats = __builtin_convertvector(numbers, Floats);
  Lanes bits;
  std::memcpy(&bits, &floats, sizeof bits);
  return larger((bits >> 20) - (127 * 8 - 1), Lanes{});
}

/// Each lane, clamped to [-bound, bound].
inline Lanes clamped(Lanes value, int32_t bound) {
  value = value < -bound ? Lanes{} - bound : value;
  return value > bound ? Lanes{} + bound : value;
}

}  // namespace isostar
