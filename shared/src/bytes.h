// Bytes of the container: little-endian, variable-length integers of seven bits a byte; the reader never overruns.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isostar {

class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::byte>& out) : out_(out) {}
  void u8(uint64_t v) { out_.push_back(static_cast<std::byte>(v)); }
  void u32(uint32_t v) {
    for (int i = 0; i < 4; ++i) u8(v >> (8 * i) & 0xFF);
  }
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

 private:
  std::vector<std::byte>& out_;
};

/// Past the end it reads zeros, and says so.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> in) : in_(in) {}
  uint32_t u8() {
    if (at_ < in_.size()) return static_cast<uint32_t>(in_[at_++]);
    overrun_ = true;
    return 0;
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
  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] bool overrun() const { return overrun_; }
  [[nodiscard]] bool malformed() const { return malformed_; }

 private:
  std::span<const std::byte> in_;
  std::size_t at_ = 0;
  bool overrun_ = false, malformed_ = false;
};

}  // namespace isostar
