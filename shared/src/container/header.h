// The header of a stream, and the quantities that follow from it.
#pragma once

#include <vector>

#include "grid/lattice.h"
#include "isostar/isostar.h"

namespace isostar {

inline constexpr int kLeastDimension = 2, kMostDimension = 4;

/// All that a decoder must know before the first layer.
struct Header {
  int version = kFormatVersion;
  int dimension = 3;      // 2: an image; 3: a volume; 4: a sequence of volumes, time last
  Coordinates<4> size{};  // samples on the first `dimension` axes, 1 on the others
  Placement placement;  // of the first three axes; for an image the third spacing is the smaller of
                        // the other two
  double isovalue = 0;
  std::vector<double> furtherIsovalues;  // §5.4, in coding order
  Polygonizer polygonizer = Polygonizer::Cubes;
  bool lossless = false;
  bool adaptive = false;       // the layers are those of an AdaptiveMesh
  bool keepsTopology = false;  // the first layer is an AdaptiveMesh with the finest level's
                               // topology; each refinement fills one level
  bool trimmed = false;        // there is a Domain layer, which codes where the domain ends
  bool fitted = false;         // magnitude refinement passes use FitCoder
  double maxError = 0;
  uint64_t vertices = 0;  // of the complete surface with Polygonizer::Cubes
  /// |sample - isovalue| = (magnitude + offset) · quantizationStep, with one offset for each sign.
  double quantizationStep = 1;
  double positiveOffset = 0.5, negativeOffset = 0.5;
  /// Samples are whole numbers of quantization steps, of 1 or of kByteStep. Otherwise the step is a
  /// power of two.
  bool whole = false;
  int32_t chunkSide = 0;  // cells of a chunk on an axis, a power of two, at least 16; 0: one chunk
  uint64_t bytes = 0;     // of all that follows the header

  static constexpr int32_t kMostBaseCells = 4;  // of the base level, on an axis
  static constexpr double kByteStep = 1.0 / 255;
  static constexpr std::size_t kMostFurther = 15;
  static constexpr double kMostMagnitude = (1 << 29) - 1;  // larger ones saturate
  static constexpr double kLeastStep = 1e-300;
  static constexpr int32_t kFarSteps = (1 << 29) - 1;

  /// The number of the finest level: as few refinements as the base's size limit allows lead from
  /// the base to the source's own grid.
  [[nodiscard]] int finestLevel() const;
  /// How many chunks a level has.
  [[nodiscard]] uint64_t chunks(int level) const;
  /// Steps per grid step in which distances to the domain's boundary are coded: 2 … 32, a power of
  /// two that follows from the bound.
  [[nodiscard]] int32_t domainFineness() const;
  /// The diagonal of a cell in these steps. Larger distances do not matter.
  [[nodiscard]] int32_t domainReach() const;
  /// Sets `whole`, the quantization step and the offsets. The first whole number of steps above the
  /// isovalue is positive with magnitude 0.
  void countWhole(double step);
  /// Is it a volume whose layers a decoder of default streams has the code of?
  [[nodiscard]] bool isDefault() const {
    return dimension == 3 && !adaptive && !keepsTopology && !trimmed && !fitted &&
           furtherIsovalues.empty();
  }
  /// The same stream relative to another of its isovalues.
  [[nodiscard]] Header at(double other) const;
  /// Is an isovalue one of the stream's, or between two of them?
  [[nodiscard]] bool spans(double other) const;
  /// How many quantization steps another isovalue lies above the first one, within ±kFarSteps.
  [[nodiscard]] int32_t shift(double other) const;
  /// By how many steps shift() may be off: 1/255 is no sum of powers of two.
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

/// Finite, with an inverse, and well within the range of single precision.
[[nodiscard]] bool invertible(const Placement& placement);

}  // namespace isostar
