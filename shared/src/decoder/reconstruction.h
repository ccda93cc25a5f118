// What a decoder knows so far, in the dimension of its stream.
#pragma once

#include <memory>

#include "container/stream.h"

namespace isostar {

class Reconstruction {
 public:
  virtual ~Reconstruction() = default;

  /// What became of a layer: was it sound, and is what is shown better for it?
  struct Outcome {
    Error error = Error::None;
    bool better = false;
  };
  /// A torn layer is the last: its bytes end early.
  virtual Outcome decode(const LayerHead& head, std::span<const std::byte> layer, bool torn) = 0;

  /// The octave that is known, -1 before the first.
  [[nodiscard]] virtual int level() const = 0;

  /// BadArgument where the dimension has no such thing.
  virtual Error show(const MeshOptions& options, Mesh& out) const = 0;
  virtual Error show(const MeshOptions& options, Contours& out) const = 0;
};

/// Of a header that is within the limits, and outlives it. Null where this build lacks the header's
/// dimension.
[[nodiscard]] std::unique_ptr<Reconstruction> reconstructionOf(const Header& header,
                                                               const Limits& limits);

}  // namespace isostar
