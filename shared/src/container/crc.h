// Cyclic redundancy checks: they find every error of one and of two bits in what a stream protects
// with them, which a hash cut to as many bits does not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace isostar {

/// Most significant bit first; starts with all bits set. `Polynomial`: without its leading term.
template <class Sum, Sum Polynomial>
class Crc {
 public:
  void add(uint8_t byte) {
    addNibble(byte >> 4);
    addNibble(byte & 15);
  }
  /// Not inlined, to keep the WebAssembly decoder small.
  [[gnu::noinline]] void add(std::span<const std::byte> bytes) {
    for (const std::byte b : bytes) add(static_cast<uint8_t>(b));
  }
  [[nodiscard]] Sum sum() const { return sum_; }

 private:
  static constexpr int kBits = 8 * sizeof(Sum);
  /// By nibble: a table of bytes would be eight times as large, in a page's decoder, too.
  static constexpr std::array<Sum, 16> kTable = [] {
    std::array<Sum, 16> table{};
    for (unsigned n = 0; n < 16; ++n) {
      auto sum = static_cast<Sum>(Sum(n) << (kBits - 4));
      for (int bit = 0; bit < 4; ++bit)
        sum = static_cast<Sum>(sum << 1 ^ (sum >> (kBits - 1) != 0 ? Polynomial : Sum{0}));
      table[n] = sum;
    }
    return table;
  }();

  void addNibble(unsigned nibble) {
    sum_ = static_cast<Sum>(sum_ << 4 ^ kTable[sum_ >> (kBits - 4) ^ nibble]);
  }

  Sum sum_ = static_cast<Sum>(~Sum{0});
};

/// CRC-16-CCITT: finds two wrong bits in up to 4 kB.
using Crc16 = Crc<uint16_t, 0x1021>;
/// CRC-32C: finds two wrong bits in up to 256 MB.
using Crc32 = Crc<uint32_t, 0x1EDC6F41>;

}  // namespace isostar
