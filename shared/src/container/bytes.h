// The bytes of the container: little-endian integers, and variable-length integers with seven bits
// a byte.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isostar {

/// Powers of ten that a double represents exactly.
inline constexpr std::array<double, 8> kTens{1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7};

/// A real number starts with a varint of kRealForms · n + form. Forms 0 … 7 count decimal digits:
/// the number is n / 10^form. In the other two a float or a double follows.
inline constexpr uint64_t kRealForms = 10, kSingle = 8, kDouble = 9;

/// Less code than insert() in WebAssembly.
inline void append(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
  const std::size_t before = out.size();
  out.resize(before + bytes.size());
  std::copy(bytes.begin(), bytes.end(), out.data() + before);
}

class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::byte>& out) : out_(out) {}
  void u8(uint64_t v) { out_.push_back(static_cast<std::byte>(v)); }
  void u16(uint32_t v) {
    u8(v & 0xFF);
    u8(v >> 8 & 0xFF);
  }
  void u32(uint32_t v) {
    for (int i = 0; i < 4; ++i) u8(v >> (8 * i) & 0xFF);
  }
  void append(std::span<const std::byte> bytes) { isostar::append(out_, bytes); }
  void f32(float v) { u32(std::bit_cast<uint32_t>(v)); }
  void f64(double v) {
    const auto bits = std::bit_cast<uint64_t>(v);
    u32(static_cast<uint32_t>(bits));
    u32(static_cast<uint32_t>(bits >> 32));
  }
  void varint(uint64_t v) {
    for (; v >= 128; v >>= 7) u8((v & 127) | 128);
    u8(v);
  }
  void zigzag(int64_t v) { varint(folded(v)); }
  /// Writes any number exactly. A short decimal fraction, such as a person would type, takes few
  /// bytes.
  void real(double v) {
    for (std::size_t digits = 0; digits < kTens.size(); ++digits) {
      const double whole = v * kTens[digits];
      if (!(std::abs(whole) < 0x1p40) || std::round(whole) / kTens[digits] != v) continue;
      const auto n = static_cast<int64_t>(std::round(whole));
      varint(folded(n) * kRealForms + digits);
      return;
    }
    const auto narrow = static_cast<float>(v);
    const bool exact = double{narrow} == v;
    varint(exact ? kSingle : kDouble);
    if (exact)
      f32(narrow);
    else
      f64(v);
  }

 private:
  /// Maps 0, -1, 1, -2 … to 0, 1, 2, 3 …, so that small numbers of either sign take few bytes.
  static uint64_t folded(int64_t v) {
    return static_cast<uint64_t>(v) << 1 ^ static_cast<uint64_t>(v >> 63);
  }

  std::vector<std::byte>& out_;
};

/// Reads untrusted input. Beyond the end it returns zeros and sets overrun().
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> in) : in_(in) {}
  /// How many bytes have not been read.
  [[nodiscard]] std::size_t left() const { return in_.size() - at_; }
  uint32_t u8() {
    if (at_ < in_.size()) return static_cast<uint32_t>(in_[at_++]);
    overrun_ = true;
    return 0;
  }
  uint32_t u16() {
    const uint32_t low = u8();
    return low | u8() << 8;
  }
  uint32_t u32() {
    uint32_t v = 0;
    for (int i = 0; i < 4; ++i) v |= u8() << (8 * i);
    return v;
  }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64() {
    const uint64_t low = u32();
    return std::bit_cast<double>(low | uint64_t{u32()} << 32);
  }
  uint64_t varint() {
    uint64_t v = 0;
    for (int shift = 0; shift < 63; shift += 7) {
      const uint64_t byte = u8();
      v |= (byte & 127) << shift;
      if (byte < 128) return v;
    }
    malformed_ = true;
    return 0;
  }
  int64_t zigzag() { return unfolded(varint()); }
  double real() {
    const uint64_t v = varint(), form = v % kRealForms;
    if (form < kTens.size()) return static_cast<double>(unfolded(v / kRealForms)) / kTens[form];
    return form == kSingle ? double{f32()} : f64();
  }
  /// The next bytes; none if there are fewer.
  std::span<const std::byte> take(std::size_t count) {
    overrun_ = overrun_ || in_.size() - at_ < count;
    if (overrun_) return {};
    at_ += count;
    return in_.subspan(at_ - count, count);
  }
  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] bool overrun() const { return overrun_; }
  [[nodiscard]] bool malformed() const { return malformed_; }

 private:
  static int64_t unfolded(uint64_t v) {
    return static_cast<int64_t>(v >> 1) ^ -static_cast<int64_t>(v & 1);
  }

  std::span<const std::byte> in_;
  std::size_t at_ = 0;
  bool overrun_ = false, malformed_ = false;
};

}  // namespace isostar
