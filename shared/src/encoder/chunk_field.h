// The source of one chunk, as an EncoderExchange queries it.
#pragma once

#include "coding/chunk_state.h"
#include "encoder/core/quantized_field.h"

namespace isostar {

/// Has its own view of the samples, so that chunks can be coded side by side. Decisions for a pass
/// are those of the whole field.
template <int D>
class ChunkField {
 public:
  /// All must outlive it.
  ChunkField(const GridField<D>& field, const Header& header, const QuantizedField<D>& whole,
             const Chunk<D>& chunk, const ChunkState<D>& state)
      : view_(field.viewOf(chunk)),
        quantized_(view_, header, state.signs()),
        whole_(whole),
        state_(state) {
    quantized_.setRdoq(whole.usesRdoq());
  }

  [[nodiscard]] uint32_t magnitude(std::size_t brickIndex, std::size_t r, int x) const {
    return quantized_.magnitude(brickIndex, r, x);
  }
  /// Empty beside the border: what neighbours code is not known there.
  template <class CodedAt, class Allowed>
  [[nodiscard]] CrossingDistortion<D> distortion(std::size_t brickIndex, std::size_t r, int x,
                                                 CodedAt codedAt, const Allowed& allowed) const {
    if (besideHalo(brickIndex, r, x)) return {};
    return quantized_.distortion(brickIndex, r, x, codedAt, allowed);
  }
  [[nodiscard]] int gradient(std::size_t brickIndex) const {
    return quantized_.gradient(brickIndex);
  }
  [[nodiscard]] int32_t domain(std::size_t, std::size_t, int) const { return 0; }
  [[nodiscard]] int displacement(std::size_t brickIndex, std::size_t block) const {
    return whole_.displacement(state_.indices()[brickIndex], block);
  }
  [[nodiscard]] bool selected(std::size_t brickIndex) const {
    return whole_.selected(state_.indices()[brickIndex]);
  }

 private:
  /// Is a neighbour of the vertex along an axis in the halo?
  [[nodiscard]] bool besideHalo(std::size_t brickIndex, std::size_t r, int x) const {
    const auto& table = state_.signs().table();
    auto at = static_cast<std::size_t>(x);
    for (int a = 0; a < D; ++a, r /= kBrickSide) {
      const std::size_t stride = table.stride(a);
      if (at == 0 && brickIndex >= stride && state_.halo()[brickIndex - stride] != 0) return true;
      if (at == kBrickSide - 1 && brickIndex + stride < state_.halo().size() &&
          state_.halo()[brickIndex + stride] != 0)
        return true;
      at = r % kBrickSide;
    }
    return false;
  }

  GridField<D> view_;
  QuantizedField<D> quantized_;
  const QuantizedField<D>& whole_;
  const ChunkState<D>& state_;
};

}  // namespace isostar
