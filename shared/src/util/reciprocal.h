// Reciprocals of small integers in fixed point, for means without a division.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace isostar {

/// Tables, because a division by a small number would cost more than the rest of the computation
/// around it.
class Reciprocals {
 public:
  [[nodiscard]] static int64_t of(int32_t n) { return kAll.small_[static_cast<std::size_t>(n)]; }
  [[nodiscard]] static int64_t ofMiddle(uint32_t n) { return kAll.middle_[n - 256]; }

 private:
  /// Fills the tables at run time: as constants they would be 1.5 kB of a page's decoder.
  /// `volatile` keeps the compiler from evaluating the loop at compile time.
  Reciprocals() {
    const volatile uint32_t first = 0;
    for (uint32_t i = first; i < 256; ++i) {
      small_[i] = i == 0 ? 0 : static_cast<int32_t>(65536 / i);
      middle_[i] = static_cast<uint32_t>((uint64_t{1} << 32) / (2 * (256 + i) + 1));
    }
  }

  static const Reciprocals kAll;
  std::array<int32_t, 256> small_{};
  std::array<uint32_t, 256> middle_{};
};

inline const Reciprocals Reciprocals::kAll;

/// 65536 / n, rounded down, for 1 ≤ n < 256; 0 for n = 0.
inline int64_t reciprocal(int32_t n) {
  return Reciprocals::of(n);
}
/// 2^31 / (n + 1/2), rounded down, for 256 ≤ n < 512.
inline int64_t reciprocalOfMiddle(uint32_t n) {
  return Reciprocals::ofMiddle(n);
}

}  // namespace isostar
