// The source's signs, gradients and precision, computed from its samples.
#include "encoder/core/field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "encoder/core/brick_tasks.h"
#include "grid/tube.h"
#include "util/simd.h"

namespace isostar {
namespace {

/// Are all samples whole numbers of a step, and on the same side of the isovalue if decoded from
/// such a number?
class WholeSamples {
 public:
  /// `perStep`: the number of steps in 1. `most`: larger samples are not such numbers, since floats
  /// are too coarse there.
  WholeSamples(double perStep, double isovalue, double most)
      : perStep_(perStep), isovalue_(isovalue), most_(most) {}
  void add(double sample) {
    if (!all_) return;
    const double n = std::round(sample * perStep_);
    all_ = std::abs(sample) <= most_ && static_cast<float>(n / perStep_) == sample &&
           (n > isovalue_ * perStep_) == (sample > isovalue_);
  }
  [[nodiscard]] bool all() const { return all_; }

 private:
  double perStep_, isovalue_, most_;
  bool all_ = true;
};

/// The largest float that is not above a value. For every float s, s > v exactly if s > floorOf(v).
float floorOf(double v) {
  constexpr float kMost = std::numeric_limits<float>::max();
  const auto nearest = static_cast<float>(std::clamp(v, -double{kMost}, double{kMost}));
  return double{nearest} > v ? std::nextafter(nearest, -std::numeric_limits<float>::infinity())
                             : nearest;
}

/// Which of eight samples are above a threshold; bit x is sample x.
unsigned above(const float* samples, float threshold) {
  using Four [[gnu::vector_size(16)]] = float;
  std::array<Four, 2> four;
  std::memcpy(&four, samples, sizeof four);
  const Four least = Four{} + threshold;
  const Lanes bits =
      ((four[0] > least) & Lanes{1, 2, 4, 8}) | ((four[1] > least) & Lanes{16, 32, 64, 128});
  return static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]);
}

/// The median of some differences: 4 log2 of quantization steps; 0 if there are none. Reorders
/// them.
int medianLog2(std::span<float> differences, double quantizationStep) {
  if (differences.empty()) return 0;
  const auto median = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), median, differences.end());
  return static_cast<int>(std::clamp(
      std::lround(4 * std::log2(std::max(1.0, double{*median} / quantizationStep))), 0L, 120L));
}

}  // namespace

template <int D>
bool sensible(std::span<const float> samples, const Coordinates<D>& size, double isovalue,
              const RunTasks& runTasks) {
  constexpr std::size_t kPiece = std::size_t{1} << 18;
  uint64_t count = 1;
  for (int32_t n : size) {
    if (n < 1 || n >= (1 << 28)) return false;
    count *= static_cast<uint64_t>(n);
    if (count > samples.size()) return false;
  }
  if (count != samples.size() || !std::isfinite(isovalue)) return false;
  std::vector<uint32_t> invalid((samples.size() + kPiece - 1) / kPiece);
  runAll(runTasks, invalid.size(), [&](std::size_t i) {
    // Counting has no early exit, so that several samples are processed at once.
    uint32_t found = 0;
    for (const float s : samples.subspan(i * kPiece, std::min(kPiece, samples.size() - i * kPiece)))
      found += std::abs(s) <= std::numeric_limits<float>::max() ? 0 : 1;
    invalid[i] = found;
  });
  return std::ranges::all_of(invalid, [](uint32_t found) { return found == 0; });
}

template <int D>
Signs<D> GridField<D>::signs(const RunTasks& runTasks) const {
  constexpr std::size_t kPieces = 64;
  Signs<D> signs(Lattice<D>(last_, 1));
  // A box without extent on an axis has no cells and so no surface.
  if (std::ranges::any_of(last_, [](int32_t last) { return last == 0; })) return signs;
  const float threshold = floorOf(isovalue_);
  // Adjacent on axis 0, so that samples are read in their order in memory.
  const auto across = static_cast<std::size_t>(table_.count(0));
  const std::size_t rows = table_.total() / across;
  std::vector<Brick<D>> bricks(table_.total());
  runAll(runTasks, kPieces, [&](std::size_t i) {
    for (std::size_t row = rows * i / kPieces; row < rows * (i + 1) / kPieces; ++row)
      rowSigns(row * across, threshold, std::span(bricks).subspan(row * across, across));
  });
  for (std::size_t brickIndex = 0; brickIndex < bricks.size(); ++brickIndex)
    signs.put(brickIndex, bricks[brickIndex]);
  return signs;
}

template <int D>
void GridField<D>::rowSigns(std::size_t first, float threshold, std::span<Brick<D>> bricks) const {
  const std::size_t last = bricks.size() - 1;
  for (std::size_t r = 0; r < bricks[0].rows.size(); ++r) {
    // Beyond the lattice its last plane is repeated, so that a uniform brick at the box's end is
    // uniform.
    Coordinates<D> v = vertex(table_.brick(first), r);
    for (int a = 1; a < D; ++a) v[a] = std::min(v[a], last_[a]);
    const float* row = &samples_[at(v)];
    for (std::size_t b = 0; b < last; ++b)
      bricks[b].rows[r] = static_cast<uint8_t>(above(row + b * kBrickSide, threshold));
    std::array<float, kBrickSide> end;
    end.fill(row[last_[0]]);
    std::copy(row + last * kBrickSide, row + last_[0] + 1, end.begin());
    bricks[last].rows[r] = static_cast<uint8_t>(above(end.data(), threshold));
  }
}

template <int D>
Precision GridField<D>::precision(Polygonizer polygonizer, const Signs<D>& signs,
                                  const std::vector<uint8_t>& active,
                                  const RunTasks& runTasks) const {
  Precision all;
  for (const Precision& piece : ofBrickPieces(active, runTasks, [&](const BrickRange& range) {
         return precisionOf(range, polygonizer, signs, active);
       }))
    all.add(piece);
  return all;
}

template <int D>
Precision GridField<D>::precisionOf(const BrickRange& range, Polygonizer polygonizer,
                                    const Signs<D>& signs,
                                    const std::vector<uint8_t>& active) const {
  double largest = 0;
  WholeSamples ones(1, isovalue_, 1 << 29), bytes(255, isovalue_, 1);
  Tube<D> tube;
  for (std::size_t brickIndex = range.first; brickIndex < range.end; ++brickIndex) {
    if (active[brickIndex] == 0) continue;
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
      if (members == Members::DiagonalEnds && polygonizer == Polygonizer::Cubes) break;
      tube.enter(signs, brickIndex, members);
      tube.forEach([&](int, std::size_t r, int x) {
        const double sample = samples_[at(vertex(tube.at(), r)) + static_cast<std::size_t>(x)];
        largest = std::max(largest, std::abs(sample - isovalue_));
        ones.add(sample);
        bytes.add(sample);
      });
    }
  }
  return {largest, ones.all(), bytes.all()};
}

void Precision::fix(Header& header) const {
  if (ones && largest < double(1 << 28)) return header.countWhole(1);
  if (bytes && largest <= 1) return header.countWhole(Header::kByteStep);
  header.quantizationStep = std::ldexp(1.0, largest > 0 ? std::ilogb(largest) - 27 : 0);
}

template <int D>
int GridField<D>::gradient(const Header& header, const Signs<D>& signs,
                           std::size_t brickIndex) const {
  const auto brick = table_.brick(brickIndex);
  Window<D> window;
  window.load(signs, brick);
  // The vertices from the plane before the brick to its last plane, as far as the lattice extends.
  Coordinates<D> from, to;
  for (int a = 0; a < D; ++a) {
    from[a] = brick[a] == 0 ? 0 : -1;
    to[a] = std::min(kBrickSide - 1, last_[a] - brick[a] * kBrickSide);
  }
  const uint32_t vertices =
      (2u << (to[0] + Window<D>::kHalo)) - (1u << (from[0] + Window<D>::kHalo));
  const bool atEnd = brick[0] * kBrickSide + to[0] == last_[0];
  const uint32_t edges = atEnd ? vertices & vertices >> 1 : vertices;  // along axis 0
  std::array<float, D * power(kBrickSide + 1, D)> differences;
  std::size_t count = 0;
  for (auto v = from;;) {
    const int row = Window<D>::row(v);
    Coordinates<D> sample;
    for (int a = 0; a < D; ++a)
      sample[a] = brick[a] * kBrickSide + (a == 0 ? -Window<D>::kHalo : v[a]);
    const auto first = static_cast<std::ptrdiff_t>(at(sample));
    for (int a = 0; a < D; ++a) {
      if (a > 0 && sample[a] == last_[a]) continue;
      const uint32_t here = window.rows[row],
                     next = a == 0 ? here >> 1 : window.rows[row + Window<D>::rowStride(a)];
      for (uint32_t crossed = (here ^ next) & (a == 0 ? edges : vertices); crossed != 0;
           crossed &= crossed - 1) {
        const auto low = static_cast<std::size_t>(first + std::countr_zero(crossed));
        differences[count++] = std::abs(samples_[low] - samples_[low + stride_[a]]);
      }
    }
    int a = 1;
    for (; a < D && ++v[a] > to[a]; ++a) v[a] = from[a];
    if (a == D) break;
  }
  return medianLog2(std::span(differences).first(count), header.quantizationStep);
}

template bool sensible<2>(std::span<const float>, const Coordinates<2>&, double, const RunTasks&);
template bool sensible<3>(std::span<const float>, const Coordinates<3>&, double, const RunTasks&);
template bool sensible<4>(std::span<const float>, const Coordinates<4>&, double, const RunTasks&);
template class GridField<2>;
template class GridField<3>;
template class GridField<4>;

}  // namespace isostar
