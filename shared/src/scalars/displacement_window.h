// The displacements of a brick and its surroundings, copied so that every neighbour is at a fixed
// offset, and their interpolation to vertices.
#pragma once

#include <cstring>

#include "grid/halo_window.h"
#include "scalars/displacements.h"

namespace isostar {

template <int D>
class DisplacementWindow : public HaloWindow<D, int8_t, Displacements<D>::kSide> {
 public:
  using Values = Displacements<D>;
  using DisplacementWindow::HaloWindow::kSide, DisplacementWindow::HaloWindow::stride,
      DisplacementWindow::HaloWindow::value;

  /// The offset of one of the brick's blocks.
  static int index(std::size_t block) { return kIndex[block]; }

  [[gnu::noinline]] void load(const Values& displacements, const BrickTable<D>& table,
                              const Coordinates<D>& brick) {
    this->gather(table, brick, displacements.nothing().data(),
                 [&](std::size_t brickIndex) { return displacements.at(brickIndex).data(); });
  }

  /// Interpolates the displacements to all vertices of the brick. Required before at().
  [[gnu::noinline]] void spread() {
    // Rows of kSide are read as eight.
    std::array<int8_t, power(kSide, D) + kBrickSide - kSide> padded{};
    std::copy(value.begin(), value.end(), padded.begin());
    std::array<Row, power(kSide, D - 1)> sums, weights;
    for (std::size_t r = 0; r < sums.size(); ++r) {
      const Row blocks = __builtin_convertvector(blocksAt(&padded[r * kSide]), Row),
                coded = blocks != Values::kNone;
      sums[r] = alongRow(blocks & coded);
      weights[r] = alongRow(-coded);
    }
    interpolate(sums.data(), sums_.data());
    interpolate(weights.data(), weights_.data());
  }
  /// The displacement at vertex x of row r of the brick, in the unit of a ShapeEstimate.
  [[nodiscard]] int32_t at(std::size_t r, int x) const {
    return sums_[r][x] * kScale[static_cast<std::size_t>(weights_[r][x])] >> 8;
  }
  /// The same for a vertex at -1 … 8 on each axis from the brick's first one: the mean of the
  /// nearest blocks. On each axis the vertex's own block has three times the weight of the one
  /// beside it.
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
      for (int a = 0; a < D; ++a, digits /= Values::kSide)
        index[block] = static_cast<int16_t>(
            index[block] + static_cast<int>(digits % Values::kSide + 1) * stride(a));
    }
    return index;
  }();

  /// The sum of the weights of the blocks around a vertex.
  static constexpr std::size_t kWeights = power(4, D);
  /// 2^8 · kPlaneSlope / kPerStep, divided by a weight.
  static constexpr std::array<int32_t, kWeights + 1> kScale = [] {
    std::array<int32_t, kWeights + 1> scale{};
    for (std::size_t weight = 1; weight <= kWeights; ++weight)
      scale[weight] = 256 * Values::kPlaneSlope / (Values::kPerStep * static_cast<int32_t>(weight));
    return scale;
  }();

  /// Eight vertices. Values and weights of blocks are summed in the same way from here on.
  using Row [[gnu::vector_size(16)]] = int16_t;
  static constexpr std::size_t kRows = power(kBrickSide, D - 1);
  static constexpr int16_t kOwn = 3;

  using Blocks [[gnu::vector_size(8)]] = int8_t;
  static Blocks blocksAt(const int8_t* first) {
    Blocks blocks;
    std::memcpy(&blocks, first, sizeof blocks);
    return blocks;
  }

  /// Three times a vertex's own block plus once the nearest one beside it, along the first axis.
  static Row alongRow(Row blocks) {
    return kOwn * __builtin_shufflevector(blocks, blocks, 1, 1, 2, 2, 3, 3, 4, 4) +
           __builtin_shufflevector(blocks, blocks, 0, 2, 1, 3, 2, 4, 3, 5);
  }
  /// The same along the other axes, from rows of blocks to rows of vertices.
  static void interpolate(const Row* blocks, Row* vertices) {
    std::array<std::array<Row, kRows / kBrickSide * kSide>, 2> between;
    std::size_t inner = 1, outer = power(kSide, D - 2);
    for (int axis = 1; axis < D; ++axis, inner *= kBrickSide, outer /= kSide) {
      Row* const to = axis == D - 1 ? vertices : between[static_cast<std::size_t>(axis) % 2].data();
      Row* out = to;
      for (std::size_t o = 0; o < outer; ++o) {
        const Row* here = blocks + o * kSide * inner;
        for (int block = 0; block < Values::kSide; ++block, out += 2 * inner) {
          here += inner;
          for (std::size_t i = 0; i < inner; ++i) {
            out[i] = kOwn * here[i] + (here - inner)[i];
            out[inner + i] = kOwn * here[i] + (here + inner)[i];
          }
        }
      }
      blocks = to;
    }
  }

  std::array<Row, kRows> sums_{}, weights_{};
};

}  // namespace isostar
