// The container, byte by byte: a header, then layers, each with a head of its own.
#pragma once

#include <span>
#include <vector>

#include "container/bytes.h"
#include "container/header.h"

namespace isostar {

/// A near layer belongs to a further isovalue, by number from 1, which stands in its head instead
/// of the octave.
enum class LayerKind : uint8_t {
  Base = 0,
  Refinement = 1,
  Exponents = 2,
  Magnitudes = 3,
  Domain = 4,
  Displacement = 5,
  FurtherSigns = 6,
  FurtherGeometry = 7
};

struct LayerHead {
  LayerKind kind = LayerKind::Base;
  int level = 0;     // octave, or number of an isovalue
  double error = 0;  // RMS distance to the source's surface, grid steps, to within 5 %
  uint64_t bytes = 0;
  uint32_t checksum = 0;
};

[[nodiscard]] inline bool isFurther(LayerKind kind) {
  return kind == LayerKind::FurtherSigns || kind == LayerKind::FurtherGeometry;
}

inline constexpr uint64_t kMostLayers = 255;

void write(ByteWriter& out, const Header& header);
void write(ByteWriter& out, const LayerHead& head);
/// Appends a layer; length and checksum of its head are set here.
void append(std::vector<std::byte>& out, LayerHead head, std::span<const std::byte> layer);

/// Truncated where more bytes are needed; `used` then stays as it is.
[[nodiscard]] Error read(std::span<const std::byte> in, Header& out, std::size_t& used);
[[nodiscard]] Error read(std::span<const std::byte> in, const Header& header, LayerHead& out,
                         std::size_t& used);

/// Of a layer under the other fields of its head; of 16 bits for a short one.
[[nodiscard]] uint32_t checksum(const LayerHead& head, std::span<const std::byte> layer);
/// Of a header between its first three bytes and the checksum itself, 16 bits.
[[nodiscard]] uint32_t checksum(std::span<const std::byte> header);

}  // namespace isostar
