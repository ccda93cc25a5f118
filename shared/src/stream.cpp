#include "stream.h"

#include <algorithm>
#include <cmath>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace isostar {
namespace {

constexpr std::array<uint8_t, 4> kMagic{'i', 's', 'o', 0xB5};
constexpr uint64_t kMostLayers = 255;
constexpr int kMostOctaves = 28;
enum Flag : uint32_t { kLossless = 1, kTetrahedra = 2, kSpacing = 4, kOrigin = 8, kDirection = 16, kInteger = 32, kKnownFlags = 63 };

/// Errors in an eighth of an octave: 0 is none, 1 is 2^-20.
uint32_t pack(double error) {
  if (!(error > 0)) return 0;
  return static_cast<uint32_t>(std::clamp(std::lround(8 * (std::log2(error) + 20)), 1L, 255L));
}
double unpack(uint32_t code) {
  if (code == 0) return 0;
  constexpr std::array<double, 8> kRoots{1, 1.0905077, 1.1892071, 1.2968396, 1.4142136, 1.5422108, 1.6817928, 1.8340081};
  return std::ldexp(kRoots[code % 8], static_cast<int>(code / 8) - 20);
}

/// Offsets of samples that are whole numbers: the first one above the isovalue is positive.
void wholeOffsets(Header& h) {
  const double fraction = h.isovalue - std::floor(h.isovalue);
  h.positiveOffset = 1 - fraction;
  h.negativeOffset = fraction;
}

}  // namespace

bool invertible(const Placement& p) {
  constexpr double kFar = 1e30, kWide = 1e20, kStretched = 1e6, kFlat = 1e-6;
  double lengths = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const double length = std::hypot(p.direction[a], p.direction[a + 3], p.direction[a + 6]);
    if (!(std::abs(p.origin[a]) < kFar) || !(p.spacing[a] > 1 / kWide && p.spacing[a] < kWide)) return false;
    if (!(length > 1 / kStretched && length < kStretched)) return false;
    lengths *= length;
  }
  const auto& d = p.direction;
  const double determinant =
      d[0] * (d[4] * d[8] - d[5] * d[7]) - d[1] * (d[3] * d[8] - d[5] * d[6]) + d[2] * (d[3] * d[7] - d[4] * d[6]);
  return std::abs(determinant) > kFlat * lengths;
}

uint32_t checksum(std::span<const std::byte> bytes) { return XXH32(bytes.data(), bytes.size(), 0); }

void write(ByteWriter& out, const Header& h) {
  const Placement plain;
  const bool whole = h.quantum == 1;
  const uint32_t flags = (h.lossless ? kLossless : 0u) | (h.polygonizer == Polygonizer::Tetrahedra ? kTetrahedra : 0u) |
                         (h.placement.spacing != plain.spacing ? kSpacing : 0u) | (h.placement.origin != plain.origin ? kOrigin : 0u) |
                         (h.placement.direction != plain.direction ? kDirection : 0u) | (whole ? kInteger : 0u);
  std::vector<std::byte> body;
  ByteWriter w(body);
  w.u8(kFormatVersion);
  w.varint(flags);
  for (int32_t n : h.size) w.varint(static_cast<uint64_t>(n));
  w.u8(static_cast<uint64_t>(h.octaves));
  w.f64(h.isovalue);
  if (!whole) w.f64(h.quantum);
  w.f32(h.maxError);
  w.varint(h.vertices);
  if (flags & kSpacing) for (double v : h.placement.spacing) w.f64(v);
  if (flags & kOrigin) for (double v : h.placement.origin) w.f64(v);
  if (flags & kDirection) for (double v : h.placement.direction) w.f64(v);
  w.varint(h.layers);
  for (uint8_t c : kMagic) out.u8(c);
  for (std::byte b : body) out.u8(static_cast<uint64_t>(b));
  out.u32(checksum(body));
}

void write(ByteWriter& out, const LayerHead& head) {
  out.u8(static_cast<uint64_t>(head.kind));
  out.u8(static_cast<uint64_t>(head.level));
  out.u8(pack(head.error));
  out.varint(head.bytes);
  out.u32(head.checksum);
}

Error read(std::span<const std::byte> in, Header& out, std::size_t& used) {
  for (std::size_t i = 0; i < std::min(in.size(), kMagic.size()); ++i) {
    if (static_cast<uint8_t>(in[i]) != kMagic[i]) return Error::NotIsostar;
  }
  if (in.size() <= kMagic.size()) return Error::Truncated;
  const auto body = in.subspan(kMagic.size());
  ByteReader r(body);
  Header h;
  const uint32_t version = r.u8();
  if (version > kFormatVersion) return Error::UnsupportedVersion;
  if (version == 0) return Error::Corrupt;
  const uint64_t flags = r.varint();
  if ((flags & ~uint64_t{kKnownFlags}) != 0) return Error::UnsupportedVersion;
  h.lossless = (flags & kLossless) != 0;
  h.polygonizer = (flags & kTetrahedra) != 0 ? Polygonizer::Tetrahedra : Polygonizer::Cubes;
  bool sane = true;
  for (int32_t& n : h.size) {
    const uint64_t v = r.varint();
    sane = sane && v >= 1 && v < (uint64_t{1} << 28);
    n = static_cast<int32_t>(v);
  }
  h.octaves = static_cast<int>(r.u8());
  sane = sane && h.octaves <= kMostOctaves;
  h.isovalue = r.f64();
  if ((flags & kInteger) != 0) wholeOffsets(h);
  else h.quantum = r.f64();
  h.maxError = r.f32();
  h.vertices = r.varint();
  if (flags & kSpacing) for (double& v : h.placement.spacing) v = r.f64();
  if (flags & kOrigin) for (double& v : h.placement.origin) v = r.f64();
  if (flags & kDirection) for (double& v : h.placement.direction) v = r.f64();
  const uint64_t layers = r.varint();
  const std::size_t length = r.position();
  const uint32_t expected = r.u32();
  if (r.malformed()) return Error::Corrupt;
  if (r.overrun()) return Error::Truncated;
  if (expected != checksum(body.first(length))) return Error::Corrupt;
  if (!sane || layers > kMostLayers || !std::isfinite(h.isovalue) || !(h.quantum > 0) || !std::isfinite(h.quantum) || !(h.maxError >= 0) ||
      !invertible(h.placement)) {
    return Error::Corrupt;
  }
  h.layers = static_cast<uint32_t>(layers);
  out = h;
  used = kMagic.size() + r.position();
  return Error::None;
}

Error read(std::span<const std::byte> in, const Header& header, LayerHead& out, std::size_t& used) {
  ByteReader r(in);
  const uint32_t kind = r.u8(), level = r.u8(), error = r.u8();
  const uint64_t bytes = r.varint();
  const uint32_t sum = r.u32();
  if (r.malformed()) return Error::Corrupt;
  if (r.overrun()) return Error::Truncated;
  if (kind > static_cast<uint32_t>(LayerKind::Halving) || level > static_cast<uint32_t>(header.octaves)) return Error::Corrupt;
  out = {static_cast<LayerKind>(kind), static_cast<int>(level), unpack(error), bytes, sum};
  used = r.position();
  return Error::None;
}

}  // namespace isostar
