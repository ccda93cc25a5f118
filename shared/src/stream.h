// The container: a header, then layers, each with a head of its own.
#pragma once

#include <span>
#include <vector>

#include "bytes.h"
#include "isostar/isostar.h"
#include "lattice.h"

namespace isostar {

inline constexpr int kLeastDimension = 2, kMostDimension = 4;

/// What a decoder must know before the first layer.
struct Header {
  int version = kFormatVersion;
  int dimension = 3;           // 2: an image; 3: a volume; 4: a sequence of volumes, time last
  Coordinates<4> size{};       // of the first `dimension` axes
  Placement placement;         // of the first three axes; an image's third spacing is its smallest
  double isovalue = 0;
  std::vector<double> near;  // further isovalues (§5.4), in the order in which they are told
  Polygonizer polygonizer = Polygonizer::Cubes;
  bool lossless = false;
  bool adaptive = false;   // layers are those of an AdaptiveMesh
  bool keepsTopology = false;  // the first layer is an AdaptiveMesh with the finest topology, each refinement fills an octave
  bool trimmed = false;  // a layer tells where the domain ends
  double maxError = 0;
  uint64_t vertices = 0;  // of the complete surface that `cubes` makes
  /// |sample - isovalue| = (magnitude + offset) · quantum, with an offset for each sign.
  double quantum = 1;
  double positiveOffset = 0.5, negativeOffset = 0.5;
  /// Samples are whole numbers of quanta, of 1 or of kByteStep; else a quantum is a power of two.
  bool whole = false;
  uint64_t bytes = 0;  // of all layers and their heads

  static constexpr int32_t kMostBaseCells = 4;  // of the base octave on an axis
  static constexpr double kByteStep = 1.0 / 255;
  static constexpr std::size_t kMostNear = 15;
  static constexpr int32_t kFarQuanta = (1 << 29) - 1;

  /// Refinements from the base to the source's own grid: as few as the base allows.
  [[nodiscard]] int octaves() const;
  /// Quanta to a grid step in which a domain's distances are told: as fine as the bound asks, 32 at most.
  [[nodiscard]] int32_t domainFineness() const;
  /// The diagonal of a cell in such quanta: no distance further away matters.
  [[nodiscard]] int32_t domainReach() const;
  /// Offsets of samples that are whole numbers of quanta: the first one above the isovalue is positive.
  void countWhole(double step);
  /// The same stream as seen from another of its isovalues.
  [[nodiscard]] Header at(double other) const;
  /// Is an isovalue one of the stream's, or between two of them?
  [[nodiscard]] bool spans(double other) const;
  /// How many quanta another isovalue lies above the first one; bounded by kFarQuanta.
  [[nodiscard]] int32_t shift(double other) const;
  /// By so many quanta a shift may be off: 1/255 is no sum of powers of two.
  [[nodiscard]] int32_t shiftError() const { return whole && quantum == 1 ? 0 : 1; }

  template <int D>
  [[nodiscard]] Lattice<D> base() const {
    Coordinates<D> last;
    for (int a = 0; a < D; ++a) last[a] = size[static_cast<std::size_t>(a)] - 1;
    return Lattice<D>(last, int32_t{1} << octaves());
  }
};

/// Dimension, size and placement of a source.
[[nodiscard]] Header headerOf(const Image& image);
[[nodiscard]] Header headerOf(const Volume& volume);
[[nodiscard]] Header headerOf(const Sequence& sequence);

/// A near layer belongs to a further isovalue, by number from 1, which stands in its head instead of the octave.
enum class LayerKind : uint8_t { Base = 0, Refinement = 1, Octaves = 2, Halving = 3, Domain = 4, Displacement = 5, NearSigns = 6, NearGeometry = 7 };

struct LayerHead {
  LayerKind kind = LayerKind::Base;
  int level = 0;     // octave, or number of an isovalue
  double error = 0;  // RMS distance to the source's surface, grid steps, to within 5 %
  uint64_t bytes = 0;
  uint32_t checksum = 0;
};

[[nodiscard]] inline bool isNear(LayerKind kind) { return kind == LayerKind::NearSigns || kind == LayerKind::NearGeometry; }

inline constexpr uint64_t kMostLayers = 255;

void write(ByteWriter& out, const Header& header);
void write(ByteWriter& out, const LayerHead& head);
/// Appends a layer; length and checksum of its head are set here.
void append(std::vector<std::byte>& out, LayerHead head, std::span<const std::byte> layer);

/// Truncated where more bytes are needed; `used` then stays as it is.
[[nodiscard]] Error read(std::span<const std::byte> in, Header& out, std::size_t& used);
[[nodiscard]] Error read(std::span<const std::byte> in, const Header& header, LayerHead& out, std::size_t& used);

/// Finite, and with an inverse; far from where single precision ends.
[[nodiscard]] bool invertible(const Placement& placement);

/// Of a layer under the other fields of its head; of 16 bits for a short one.
[[nodiscard]] uint32_t checksum(const LayerHead& head, std::span<const std::byte> layer);
/// Of a header between its first three bytes and the checksum itself, 16 bits.
[[nodiscard]] uint32_t checksum(std::span<const std::byte> header);

}  // namespace isostar
