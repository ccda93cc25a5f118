// Reciprocals of small integers in fixed point, for means without a division.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace isostar {

/// 65536 / n, rounded down, for 1 ≤ n < 256; 0 for n = 0. A table, because a division by a small
/// number would cost more than the rest of the computation around it.
inline int64_t reciprocal(int32_t n) {
  static constexpr std::array<int32_t, 256> kTable = [] {
    std::array<int32_t, 256> table{};
    for (int32_t i = 1; i < 256; ++i) table[static_cast<std::size_t>(i)] = 65536 / i;
    return table;
  }();
  return kTable[static_cast<std::size_t>(n)];
}

}  // namespace isostar
