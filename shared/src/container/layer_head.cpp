// Reads and writes layer heads, with their checksums.
#include <algorithm>
#include <cmath>

#include "container/crc.h"
#include "container/layer_fields.h"

namespace isostar {
namespace {

constexpr std::size_t kShort = 1024;  // layers with fewer bytes have checksums of 16 bits

/// A layer's error from a scale of eight steps per factor of two: 0 is no error, 8 is 2^-19.
double unpack(uint32_t code) {
  if (code == 0) return 0;
  constexpr std::array<double, 8> kRoots{1,         1.0905077, 1.1892071, 1.2968396,
                                         1.4142136, 1.5422108, 1.6817928, 1.8340081};
  return std::ldexp(kRoots[code % 8], static_cast<int>(code / 8) - 20);
}

/// The nearest step of that scale. Without a logarithm, whose tables a page would have to download.
uint32_t pack(double error) {
  if (!(error > 0)) return 0;
  uint32_t code = 1;
  while (code < 255 && error * error >= unpack(code) * unpack(code + 1)) ++code;
  return code;
}

/// Kind and level of a layer in one byte.
uint32_t packed(const LayerHead& head) {
  return static_cast<uint32_t>(head.kind) << 5 | static_cast<uint32_t>(head.level);
}

}  // namespace

uint32_t checksum(const LayerHead& head, std::span<const std::byte> layer, std::size_t number) {
  const auto sumOf = [&](auto crc) -> uint32_t {
    crc.add(static_cast<uint8_t>(number));
    crc.add(static_cast<uint8_t>(packed(head)));
    crc.add(static_cast<uint8_t>(pack(head.error)));
    for (int shift = 0; shift < 64; shift += 8) crc.add(static_cast<uint8_t>(head.bytes >> shift));
    crc.add(layer);
    return crc.sum();
  };
  return head.bytes < kShort ? sumOf(Crc16()) : sumOf(Crc32());
}

void writeFields(ByteWriter& out, const LayerHead& head) {
  out.u8(packed(head));
  out.u8(pack(head.error));
}

bool readFields(uint32_t first, uint32_t error, const Header& header, LayerHead& out) {
  out.kind = static_cast<LayerKind>(first >> 5);
  out.level = static_cast<int>(first & 31);
  out.error = unpack(error);
  const bool numbered =
      out.level >= 1 && static_cast<std::size_t>(out.level) <= header.furtherIsovalues.size();
  return traitsOf(out.kind).isFurther ? numbered : out.level <= header.finestLevel();
}

void write(ByteWriter& out, const LayerHead& head) {
  writeFields(out, head);
  out.varint(head.bytes);
  if (head.bytes < kShort)
    out.u16(head.checksum);
  else
    out.u32(head.checksum);
}

void append(std::vector<std::byte>& out, LayerHead head, std::span<const std::byte> layer,
            std::size_t number) {
  head.bytes = layer.size();
  head.checksum = checksum(head, layer, number);
  ByteWriter writer(out);
  write(writer, head);
  out.insert(out.end(), layer.begin(), layer.end());
}

Error read(std::span<const std::byte> in, const Header& header, LayerHead& out, std::size_t& used) {
  ByteReader r(in);
  const uint32_t first = r.u8(), error = r.u8();
  const uint64_t bytes = r.varint();
  const uint32_t sum = bytes < kShort ? r.u16() : r.u32();
  if (r.malformed()) return Error::Corrupt;
  if (r.overrun()) return Error::Truncated;
  LayerHead head;
  if (!readFields(first, error, header, head)) return Error::Corrupt;
  head.bytes = bytes;
  head.checksum = sum;
  out = std::move(head);
  used = r.position();
  return Error::None;
}

}  // namespace isostar
