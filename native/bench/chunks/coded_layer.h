// The encoder's answers for a chunk, taken from a whole stream that has been decoded.
#pragma once

#include "bench/chunks/chunk_part.h"

namespace isostar::bench {

/// What a layer changed: the state of the whole stream before and after it.
class CodedLayer {
 public:
  CodedLayer(const ChunkPart& chunk, const CodecState<3>& after, const Scalars<3>& scalarsBefore,
             const Displacements<3>& displacementsBefore, const DisplacementPass& pass)
      : chunk_(chunk),
        after_(after),
        scalarsBefore_(scalarsBefore),
        displacementsBefore_(displacementsBefore),
        pass_(pass) {}

  /// A magnitude in the interval that the layer left.
  [[nodiscard]] uint32_t magnitude(std::size_t brick, std::size_t r, int x) const {
    return after_.scalars.at(chunk_.indices[brick]).low(r * kBrickSide + static_cast<size_t>(x));
  }
  [[nodiscard]] int gradient(std::size_t brick) const {
    return after_.scalars.gradient(chunk_.indices[brick]);
  }
  [[nodiscard]] bool selected(std::size_t brick) const {
    const std::size_t index = chunk_.indices[brick];
    return scalarsBefore_.at(index).value != after_.scalars.at(index).value;
  }
  [[nodiscard]] int32_t domain(std::size_t, std::size_t, int) const { return 0; }
  /// Of the cube whose lower corner is a block: by how many steps all its blocks moved.
  [[nodiscard]] int displacement(std::size_t brick, std::size_t block) const {
    const auto& now = after_.displacements.at(chunk_.indices[brick]);
    const int side = 1 << (pass_.log2Side - 1);
    Coordinates<3> low{}, high;
    for (int a = 0; a < 3; ++a, block /= Displacements<3>::kSide) {
      low[a] = static_cast<int32_t>(block % Displacements<3>::kSide);
      high[a] = low[a] + side - 1;
    }
    int steps = 0;
    forEachBetween<3>(low, high, [&](const Coordinates<3>& v) {
      const std::size_t at = Displacements<3>::blockAt(v);
      if (now[at] != Displacements<3>::kNone) steps = (now[at] - before(brick, at)) / pass_.step;
    });
    return steps;
  }

 private:
  [[nodiscard]] int before(std::size_t brick, std::size_t block) const {
    if (displacementsBefore_.tableSize() == 0) return 0;
    const int8_t value = displacementsBefore_.at(chunk_.indices[brick])[block];
    return value == Displacements<3>::kNone ? 0 : value;
  }

  const ChunkPart& chunk_;
  const CodecState<3>& after_;
  const Scalars<3>& scalarsBefore_;
  const Displacements<3>& displacementsBefore_;
  DisplacementPass pass_;
};

}  // namespace isostar::bench
