// The container: a header, then layers, each with a head of its own.
#pragma once

#include <span>

#include "bytes.h"
#include "isostar/isostar.h"
#include "lattice.h"

namespace isostar {

/// What a decoder must know before the first layer.
struct Header {
  std::array<int32_t, 3> size{};
  int octaves = 0;  // refinements from the base to the source's own grid
  Placement placement;
  double isovalue = 0;
  Polygonizer polygonizer = Polygonizer::Cubes;
  bool lossless = false;
  float maxError = 0;
  uint64_t vertices = 0;  // of the complete surface that `cubes` makes
  /// |sample - isovalue| = (magnitude + offset) · quantum, with an offset for each sign.
  double quantum = 1;
  double positiveOffset = 0.5, negativeOffset = 0.5;
  uint32_t layers = 0;

  static constexpr int32_t kMostBaseCells = 8;  // of the base octave on an axis

  [[nodiscard]] Lattice<3> base() const { return Lattice<3>({size[0] - 1, size[1] - 1, size[2] - 1}, int32_t{1} << octaves); }
};

enum class LayerKind : uint8_t { Base = 0, Refinement = 1, Octaves = 2, Halving = 3 };

struct LayerHead {
  LayerKind kind = LayerKind::Base;
  int level = 0;
  double error = 0;  // RMS distance to the source's surface, grid steps, to within 5 %
  uint64_t bytes = 0;
  uint32_t checksum = 0;  // of the layer's bytes
};

void write(ByteWriter& out, const Header& header);
void write(ByteWriter& out, const LayerHead& head);

/// Truncated where more bytes are needed; `used` then stays as it is.
[[nodiscard]] Error read(std::span<const std::byte> in, Header& out, std::size_t& used);
[[nodiscard]] Error read(std::span<const std::byte> in, const Header& header, LayerHead& out, std::size_t& used);

/// Finite, and with an inverse; far from where single precision ends.
[[nodiscard]] bool invertible(const Placement& placement);

[[nodiscard]] uint32_t checksum(std::span<const std::byte> bytes);

}  // namespace isostar
