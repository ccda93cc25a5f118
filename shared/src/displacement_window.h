// A brick's displacements with those next to it, copied where every neighbour is a fixed offset away.
#pragma once

#include "displacements.h"
#include "halo_window.h"

namespace isostar {

template <int D>
class DisplacementWindow : public HaloWindow<D, int8_t, Displacements<D>::kSide> {
 public:
  using Values = Displacements<D>;
  using DisplacementWindow::HaloWindow::kSide, DisplacementWindow::HaloWindow::stride, DisplacementWindow::HaloWindow::value;

  /// Of a block of the brick.
  static int index(std::size_t block) { return kIndex[block]; }

  [[gnu::noinline]] void load(const Values& displacements, const BrickTable<D>& table, const Coordinates<D>& brick) {
    this->gather(table, brick, displacements.nothing().data(), [&](std::size_t place) { return displacements.at(place).data(); });
  }

  /// Makes at() ready.
  [[gnu::noinline]] void spread() {
    std::array<int32_t, power(kSide, D)> blocks;
    for (std::size_t i = 0; i < value.size(); ++i) blocks[i] = value[i] == Values::kNone ? 0 : value[i] * kSum + 1;
    interpolate(blocks.data());
  }
  /// Of vertex x of row r of the brick, as a ShapeEstimate counts.
  [[nodiscard]] int32_t at(std::size_t r, int x) const {
    const int32_t both = vertices_[r * kBrickSide + static_cast<std::size_t>(x)], weight = both & (kSum - 1), sum = (both - weight) / kSum;
    return sum * kScale[static_cast<std::size_t>(weight)] >> 8;
  }
  /// Of a vertex, -1 … 8 on each axis from the brick's first one: the mean of the blocks nearest to it, its own with three times
  /// the weight on each axis.
  [[nodiscard]] int32_t smooth(const Coordinates<D>& vertex) const {
    int first = 0;
    std::array<int, D> beside{};
    for (int a = 0; a < D; ++a) {
      first += (vertex[a] + 2) / 2 * stride(a);
      beside[static_cast<std::size_t>(a)] = (vertex[a] & 1) != 0 ? stride(a) : -stride(a);
    }
    int32_t sum = 0, weights = 0;
    for (std::size_t n = 0; n < power(2, D); ++n) {
      int at = first;
      int32_t weight = 1;
      for (int a = 0; a < D; ++a) {
        const bool own = (n >> a & 1) == 0;
        at += own ? 0 : beside[static_cast<std::size_t>(a)];
        weight *= own ? 3 : 1;
      }
      const int8_t here = value[static_cast<std::size_t>(at)];
      if (here == Values::kNone) continue;
      sum += weight * here;
      weights += weight;
    }
    return weights == 0 ? 0 : sum * Values::kPlaneSlope / (weights * Values::kPerStep);
  }

 private:
  static constexpr std::array<int16_t, Values::kBlocks> kIndex = [] {
    std::array<int16_t, Values::kBlocks> index{};
    for (std::size_t block = 0; block < index.size(); ++block) {
      std::size_t digits = block;
      for (int a = 0; a < D; ++a, digits /= Values::kSide) index[block] = static_cast<int16_t>(index[block] + static_cast<int>(digits % Values::kSide + 1) * stride(a));
    }
    return index;
  }();

  static constexpr std::size_t kWeights = power(4, D);  // of the blocks around a vertex, all together
  /// 2^8 · kPlaneSlope / kPerStep over a weight.
  static constexpr std::array<int32_t, kWeights + 1> kScale = [] {
    std::array<int32_t, kWeights + 1> scale{};
    for (std::size_t weight = 1; weight <= kWeights; ++weight) scale[weight] = 256 * Values::kPlaneSlope / (Values::kPerStep * static_cast<int32_t>(weight));
    return scale;
  }();

  /// A sum and its weights in one number: so many to the sum's one.
  static constexpr int32_t kSum = 1 << 16;

  /// From blocks to the brick's vertices, axis by axis: three times a vertex's own block and once the nearest one beside it.
  void interpolate(const int32_t* blocks) {
    std::array<int32_t, power(kBrickSide, D - 1) * kSide> from, to;
    std::size_t inner = 1, outer = power(kSide, D - 1);
    for (int axis = 0; axis < D; ++axis, inner *= kBrickSide, outer /= kSide) {
      int32_t* out = axis == D - 1 ? vertices_.data() : to.data();
      for (std::size_t o = 0; o < outer; ++o) {
        const int32_t* here = blocks + o * kSide * inner;
        for (int block = 0; block < Values::kSide; ++block, out += 2 * inner) {
          here += inner;
          for (std::size_t i = 0; i < inner; ++i) {
            out[i] = 3 * here[i] + here[i - inner];
            out[inner + i] = 3 * here[i] + here[inner + i];
          }
        }
      }
      from.swap(to);
      blocks = from.data();
    }
  }

  std::array<int32_t, power(kBrickSide, D)> vertices_{};
};

}  // namespace isostar
