// Means of a few numbers without a division.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace isostar {

/// 65536 / n: a division by a small number would cost more than all the rest.
inline int64_t reciprocal(int32_t n) {
  static constexpr std::array<int32_t, 256> kTable = [] {
    std::array<int32_t, 256> table{};
    for (int32_t i = 1; i < 256; ++i) table[static_cast<std::size_t>(i)] = 65536 / i;
    return table;
  }();
  return kTable[static_cast<std::size_t>(n)];
}

}  // namespace isostar
