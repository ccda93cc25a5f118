// What a stream's header says, and what follows from it.
#pragma once

#include <vector>

#include "grid/lattice.h"
#include "isostar/isostar.h"

namespace isostar {

inline constexpr int kLeastDimension = 2, kMostDimension = 4;

/// What a decoder must know before the first layer.
struct Header {
  int version = kFormatVersion;
  int dimension = 3;      // 2: an image; 3: a volume; 4: a sequence of volumes, time last
  Coordinates<4> size{};  // of the first `dimension` axes
  Placement placement;    // of the first three axes; an image's third spacing is its smallest
  double isovalue = 0;
  std::vector<double>
      furtherIsovalues;  // further isovalues (§5.4), in the order in which they are told
  Polygonizer polygonizer = Polygonizer::Cubes;
  bool lossless = false;
  bool adaptive = false;       // layers are those of an AdaptiveMesh
  bool keepsTopology = false;  // the first layer is an AdaptiveMesh with the finest topology, each
                               // refinement fills an octave
  bool trimmed = false;        // a layer tells where the domain ends
  bool fitted = false;         // intervals are halved by FitCoder
  double maxError = 0;
  uint64_t vertices = 0;  // of the complete surface that `cubes` makes
  /// |sample - isovalue| = (magnitude + offset) · quantum, with an offset for each sign.
  double quantizationStep = 1;
  double positiveOffset = 0.5, negativeOffset = 0.5;
  /// Samples are whole numbers of quanta, of 1 or of kByteStep; else a quantum is a power of two.
  bool whole = false;
  uint64_t bytes = 0;  // of all layers and their heads

  static constexpr int32_t kMostBaseCells = 4;  // of the base octave on an axis
  static constexpr double kByteStep = 1.0 / 255;
  static constexpr std::size_t kMostFurther = 15;
  static constexpr int32_t kFarSteps = (1 << 29) - 1;

  /// Refinements from the base to the source's own grid: as few as the base allows.
  [[nodiscard]] int finestLevel() const;
  /// Quanta to a grid step in which a domain's distances are told: as fine as the bound asks, 32 at
  /// most.
  [[nodiscard]] int32_t domainFineness() const;
  /// The diagonal of a cell in such quanta: no distance further away matters.
  [[nodiscard]] int32_t domainReach() const;
  /// Offsets of samples that are whole numbers of quanta: the first one above the isovalue is
  /// positive.
  void countWhole(double step);
  /// The same stream as seen from another of its isovalues.
  [[nodiscard]] Header at(double other) const;
  /// Is an isovalue one of the stream's, or between two of them?
  [[nodiscard]] bool spans(double other) const;
  /// How many quanta another isovalue lies above the first one; bounded by kFarQuanta.
  [[nodiscard]] int32_t shift(double other) const;
  /// By so many quanta a shift may be off: 1/255 is no sum of powers of two.
  [[nodiscard]] int32_t shiftError() const { return whole && quantizationStep == 1 ? 0 : 1; }

  template <int D>
  [[nodiscard]] Lattice<D> base() const {
    Coordinates<D> last;
    for (int a = 0; a < D; ++a) last[a] = size[static_cast<std::size_t>(a)] - 1;
    return Lattice<D>(last, int32_t{1} << finestLevel());
  }
};

/// Dimension, size and placement of a source.
[[nodiscard]] Header headerOf(const Image& image);
[[nodiscard]] Header headerOf(const Volume& volume);
[[nodiscard]] Header headerOf(const Sequence& sequence);

/// Finite, and with an inverse; far from where single precision ends.
[[nodiscard]] bool invertible(const Placement& placement);

}  // namespace isostar
