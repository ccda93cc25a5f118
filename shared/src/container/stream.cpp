// Reads and writes headers, with their checksums.
#include "container/stream.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "container/crc.h"

namespace isostar {
namespace {

/// The fourth byte has its top bit set, which no text has; it also holds the version and the
/// dimension.
constexpr std::array<uint8_t, 3> kMagic{'i', 's', 'o'};
constexpr uint32_t kBinary = 0x80;
constexpr uint32_t kLeastLog2Side = 4, kMostLog2Side = 16;  // of a chunk, in cells
enum Flag : uint32_t {
  kLossless = 1,
  kTetrahedra = 2,
  kSpacing = 4,
  kOrigin = 8,
  kDirection = 16,
  kWhole = 32,
  kByteSteps = 64,
  kAdaptive = 128,
  kFurther = 256,
  kKeepsTopology = 512,
  kTrimmed = 1024,
  kFitted = 2048,
  kChunked = 4096,
  kKnownFlags = 8191
};

/// For how many axes a stream stores spacing and origin.
std::size_t placed(const Header& h) {
  return static_cast<std::size_t>(std::min(h.dimension, 3));
}

template <std::size_t N>
bool differ(const std::array<double, N>& a, const std::array<double, N>& b, std::size_t axes) {
  return !std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(axes), b.begin());
}

/// The first byte after the magic: format version and dimension.
Error readVersion(uint32_t first, Header& h) {
  const uint32_t version = first >> 2 & 31;
  if ((first & kBinary) == 0) return Error::NotIsostar;
  if (version > kFormatVersion) return Error::UnsupportedVersion;
  if (version == 0) return Error::Corrupt;
  h.version = static_cast<int>(version);
  h.dimension = static_cast<int>(first & 3) + kLeastDimension;
  return h.dimension > kMostDimension ? Error::UnsupportedVersion : Error::None;
}

void setFlags(Header& h, uint64_t flags) {
  h.lossless = (flags & kLossless) != 0;
  h.adaptive = (flags & kAdaptive) != 0;
  h.keepsTopology = (flags & kKeepsTopology) != 0;
  h.trimmed = (flags & kTrimmed) != 0;
  h.fitted = (flags & kFitted) != 0;
  h.polygonizer = (flags & kTetrahedra) != 0 ? Polygonizer::Tetrahedra : Polygonizer::Cubes;
}

/// False if a number of samples is out of range.
bool readSize(ByteReader& r, Header& h) {
  bool sane = true;
  for (std::size_t a = 0; a < static_cast<std::size_t>(h.dimension); ++a) {
    const uint64_t v = r.varint();
    sane = sane && v >= 1 && v < (uint64_t{1} << 28);
    h.size[a] = static_cast<int32_t>(v);
  }
  std::fill(h.size.begin() + h.dimension, h.size.end(), 1);
  return sane;
}

/// False if there are too many.
bool readIsovalues(ByteReader& r, uint64_t flags, Header& h) {
  h.isovalue = r.real();
  const uint64_t others = (flags & kFurther) != 0 ? r.varint() : 0;
  if (others > Header::kMostFurther) return false;
  for (uint64_t i = 0; i < others; ++i) h.furtherIsovalues.push_back(r.real());
  return true;
}

void readPlacement(ByteReader& r, uint64_t flags, Header& h) {
  const std::size_t axes = placed(h);
  auto& [origin, spacing, direction] = h.placement;
  for (std::size_t a = 0; (flags & kSpacing) != 0 && a < axes; ++a) spacing[a] = r.real();
  for (std::size_t a = 0; (flags & kOrigin) != 0 && a < axes; ++a) origin[a] = r.real();
  if ((flags & kDirection) != 0)
    for (double& v : direction) v = r.real();
  if (h.dimension == 2) spacing[2] = std::min(spacing[0], spacing[1]);
}

/// Are all numbers usable, and do the header's properties go together?
bool consistent(const Header& h, uint64_t flags) {
  if (!std::isfinite(h.isovalue) || !(h.maxError >= 0) || !std::isfinite(h.maxError) ||
      !invertible(h.placement) ||
      !std::ranges::all_of(h.furtherIsovalues, [](double v) { return std::isfinite(v); }))
    return false;
  if (h.dimension == 2 && (flags & kDirection) != 0) return false;
  if (h.adaptive && (h.keepsTopology || !h.furtherIsovalues.empty())) return false;
  if (h.chunkSide != 0 && (h.dimension != 3 || h.adaptive || h.keepsTopology || h.trimmed ||
                           !h.furtherIsovalues.empty()))
    return false;
  return !h.trimmed ||
         (h.dimension == 3 && !h.adaptive && !h.keepsTopology && h.furtherIsovalues.empty());
}

}  // namespace

uint32_t checksum(std::span<const std::byte> header) {
  Crc16 crc;
  crc.add(header);
  return crc.sum();
}

void write(ByteWriter& out, const Header& h) {
  const Placement plain;
  const std::size_t axes = placed(h);
  const auto& [origin, spacing, direction] = h.placement;
  const bool turned = h.dimension > 2 && direction != plain.direction;
  const uint32_t flags =
      (h.lossless ? kLossless : 0u) | (h.adaptive ? kAdaptive : 0u) |
      (h.polygonizer == Polygonizer::Tetrahedra ? kTetrahedra : 0u) |
      (differ(spacing, plain.spacing, axes) ? kSpacing : 0u) |
      (differ(origin, plain.origin, axes) ? kOrigin : 0u) | (turned ? kDirection : 0u) |
      (h.whole ? kWhole : 0u) | (h.whole && h.quantizationStep != 1 ? kByteSteps : 0u) |
      (h.furtherIsovalues.empty() ? 0u : kFurther) | (h.keepsTopology ? kKeepsTopology : 0u) |
      (h.trimmed ? kTrimmed : 0u) | (h.fitted ? kFitted : 0u) | (h.chunkSide != 0 ? kChunked : 0u);
  std::vector<std::byte> body;
  ByteWriter w(body);
  w.u8(kBinary | static_cast<uint32_t>(h.version) << 2 |
       static_cast<uint32_t>(h.dimension - kLeastDimension));
  w.varint(flags);
  for (std::size_t a = 0; a < static_cast<std::size_t>(h.dimension); ++a)
    w.varint(static_cast<uint64_t>(h.size[a]));
  w.real(h.isovalue);
  if (!h.furtherIsovalues.empty()) w.varint(h.furtherIsovalues.size());
  for (const double other : h.furtherIsovalues) w.real(other);
  if (!h.whole) w.zigzag(std::ilogb(h.quantizationStep));
  if (!h.lossless) w.real(h.maxError);
  w.varint(h.vertices);
  for (std::size_t a = 0; (flags & kSpacing) != 0 && a < axes; ++a) w.real(spacing[a]);
  for (std::size_t a = 0; (flags & kOrigin) != 0 && a < axes; ++a) w.real(origin[a]);
  if (turned)
    for (double v : direction) w.real(v);
  if (h.chunkSide != 0)
    w.u8(static_cast<uint64_t>(std::countr_zero(static_cast<uint32_t>(h.chunkSide))));
  w.varint(h.bytes);
  const uint32_t sum = checksum(body);
  for (uint8_t c : kMagic) out.u8(c);
  for (std::byte b : body) out.u8(static_cast<uint64_t>(b));
  out.u16(sum);
}

Error read(std::span<const std::byte> in, Header& out, std::size_t& used) {
  for (std::size_t i = 0; i < std::min(in.size(), kMagic.size()); ++i) {
    if (static_cast<uint8_t>(in[i]) != kMagic[i]) return Error::NotIsostar;
  }
  if (in.size() <= kMagic.size()) return Error::Truncated;
  const auto body = in.subspan(kMagic.size());
  ByteReader r(body);
  Header h;
  if (const Error error = readVersion(r.u8(), h); error != Error::None) return error;
  const uint64_t flags = r.varint();
  if (r.malformed()) return Error::Corrupt;
  if (r.overrun()) return Error::Truncated;
  if ((flags & ~uint64_t{kKnownFlags}) != 0) return Error::UnsupportedVersion;
  setFlags(h, flags);
  bool sane = readSize(r, h);
  if (!readIsovalues(r, flags, h)) return Error::Corrupt;
  int64_t exponent = 0;
  if ((flags & kWhole) != 0)
    h.countWhole((flags & kByteSteps) != 0 ? Header::kByteStep : 1);
  else
    exponent = r.zigzag();
  sane = sane && std::abs(exponent) < 1000;
  if (!h.whole && sane) h.quantizationStep = std::ldexp(1.0, static_cast<int>(exponent));
  if (!h.lossless) h.maxError = r.real();
  h.vertices = r.varint();
  readPlacement(r, flags, h);
  if ((flags & kChunked) != 0) {
    const uint32_t log2Side = r.u8();
    sane = sane && log2Side >= kLeastLog2Side && log2Side <= kMostLog2Side;
    h.chunkSide = sane ? int32_t{1} << log2Side : 0;
  }
  h.bytes = r.varint();
  const std::size_t length = r.position();
  const uint32_t expected = r.u16();
  if (r.malformed()) return Error::Corrupt;
  if (r.overrun()) return Error::Truncated;
  if (expected != checksum(body.first(length))) return Error::Corrupt;
  if (!sane || !consistent(h, flags)) return Error::Corrupt;
  out = h;
  used = kMagic.size() + r.position();
  return Error::None;
}

}  // namespace isostar
