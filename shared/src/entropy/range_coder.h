// Binary range coding: an encoder, a decoder and a meter with the same call signature (§5: "the
// final arithmetic coder"). Carry-propagating range coder after G. Martin (1979): 32-bit range,
// output in bytes, probabilities of 16 bits.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isostar {

/// Probabilities are those of `true`, in units of 1/65536, within [kLeastProbability,
/// kProbabilityOne - kLeastProbability].
inline constexpr uint32_t kProbabilityOne = 1u << 16;
inline constexpr uint32_t kLeastProbability = 24;

/// Appends coded decisions to `out`, which must outlive the encoder; bit() returns the value it was
/// given.
class RangeEncoder {
 public:
  explicit RangeEncoder(std::vector<std::byte>& out) : out_(out) {}

  bool bit(bool actual, uint32_t probability) {
    const uint32_t split = (range_ >> 16) * probability;
    if (actual) {
      range_ = split;
    } else {
      low_ += split;
      range_ -= split;
    }
    while (range_ < (1u << 24)) {
      shiftLow();
      range_ <<= 8;
    }
    return actual;
  }

  /// Ends the code; call it once, after the last bit(). Up to four zero bytes at the end are left
  /// out: the decoder reads zeros past the end.
  void finish() {
    // Of all numbers in [low, low + range), take the one with the most trailing zero bytes.
    for (int keep = 24; keep >= 0; keep -= 8) {
      const uint64_t mask = (uint64_t{1} << keep) - 1;
      const uint64_t rounded = (low_ + mask) & ~mask;
      if (rounded < low_ + range_) {
        low_ = rounded;
        break;
      }
    }
    for (int i = 0; i < 5; ++i) shiftLow();
    for (int i = 0; i < 4 && out_.size() > start_ && out_.back() == std::byte{0}; ++i)
      out_.pop_back();
  }

 private:
  void shiftLow() {
    const bool carry = (low_ >> 32) != 0;
    if (carry || static_cast<uint32_t>(low_) < 0xFF000000u) {
      if (pending_ != 0) {
        // The first byte is always zero and is not written.
        if (!first_) out_.push_back(static_cast<std::byte>(cache_ + carry));
        first_ = false;
        for (; pending_ > 1; --pending_) out_.push_back(static_cast<std::byte>(0xFF + carry));
      }
      pending_ = 0;
      cache_ = static_cast<uint8_t>(low_ >> 24);
    }
    ++pending_;
    low_ = (low_ & 0x00FFFFFFu) << 8;
  }

  std::vector<std::byte>& out_;
  std::size_t start_ = out_.size();
  uint64_t low_ = 0;
  uint64_t pending_ = 1;
  uint32_t range_ = 0xFFFFFFFFu;
  uint8_t cache_ = 0;
  bool first_ = true;
};

/// Decodes decisions; bit() ignores its first argument. `in` must outlive the decoder. Past its end
/// the decoder reads zeros and counts them.
class RangeDecoder {
 public:
  explicit RangeDecoder(std::span<const std::byte> in)
      : next_(in.data()), end_(in.data() + in.size()) {
    for (int i = 0; i < 4; ++i) code_ = code_ << 8 | byte();
  }

  bool bit(bool /*actual*/, uint32_t probability) {
    ++decisions_;
    const uint32_t split = (range_ >> 16) * probability;
    const bool value = code_ < split;
    // Masks instead of a branch: what a good model leaves is hard to predict for a processor.
    const uint32_t upper = value ? 0 : ~0u;
    code_ -= split & upper;
    range_ = split + ((range_ - 2 * split) & upper);
    while (range_ < (1u << 24)) {
      code_ = code_ << 8 | byte();
      range_ <<= 8;
    }
    return value;
  }

  /// How many bytes past the end have been read: at most 4 when an intact code has been decoded.
  [[nodiscard]] std::size_t overrun() const { return overrun_; }
  /// How many decisions have been decoded: few bytes can hold very many.
  [[nodiscard]] uint64_t decisions() const { return decisions_; }

 private:
  uint32_t byte() {
    if (next_ != end_) return static_cast<uint32_t>(*next_++);
    ++overrun_;
    return 0;
  }

  const std::byte* next_;
  const std::byte* end_;
  uint32_t code_ = 0;
  uint32_t range_ = 0xFFFFFFFFu;
  std::size_t overrun_ = 0;
  uint64_t decisions_ = 0;
};

/// Writes nothing; sums up how many bits the decisions cost.
class Meter {
 public:
  bool bit(bool actual, uint32_t probability) {
    bits_ -=
        std::log2((actual ? probability : kProbabilityOne - probability) / double(kProbabilityOne));
    return actual;
  }
  [[nodiscard]] double bits() const { return bits_; }

 private:
  double bits_ = 0;
};

}  // namespace isostar
