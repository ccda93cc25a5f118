#include "field.h"

#include <algorithm>
#include <cmath>

#include "octave.h"
#include "tube.h"

namespace isostar {
namespace {

/// Are samples whole numbers of a step, each on the right side of the isovalue also as such a number?
class WholeSamples {
 public:
  /// `perStep`: so many steps are 1.
  WholeSamples(double perStep, double isovalue) : perStep_(perStep), isovalue_(isovalue) {}
  void see(double sample) {
    const double n = std::round(sample * perStep_);
    all_ = all_ && static_cast<float>(n / perStep_) == sample && (n > isovalue_ * perStep_) == (sample > isovalue_);
  }
  [[nodiscard]] bool all() const { return all_; }

 private:
  double perStep_, isovalue_;
  bool all_ = true;
};

}  // namespace

template <int D>
bool sensible(std::span<const float> samples, const Coordinates<D>& size, double isovalue) {
  uint64_t count = 1;
  for (int32_t n : size) {
    if (n < 1 || n >= (1 << 28)) return false;
    count *= static_cast<uint64_t>(n);
    if (count > samples.size()) return false;
  }
  return count == samples.size() && std::isfinite(isovalue) && std::ranges::all_of(samples, [](float s) { return std::isfinite(s); });
}

template <int D>
Signs<D> GridField<D>::signs(int32_t step) const {
  const Lattice<D> lattice(last_, step);
  Signs<D> signs(lattice);
  // A box without extent on an axis has no cells, and so no surface.
  if (std::ranges::any_of(last_, [](int32_t last) { return last == 0; })) return signs;
  const auto& table = signs.table();
  for (std::size_t place = 0; place < table.total(); ++place) {
    const auto brick = table.brick(place);
    Brick<D> bits;
    for (std::size_t r = 0; r < bits.rows.size(); ++r) {
      // Beyond the lattice the last plane goes on, so that a uniform brick at the box's end is one.
      Coordinates<D> v = vertex(brick, r);
      v[0] = 0;
      for (int a = 1; a < D; ++a) v[a] = lattice.sample(a, std::min(v[a], lattice.last[a]));
      const float* row = &samples_[at(v)];
      unsigned byte = 0;
      for (int x = 0; x < kBrickSide; ++x) {
        const int32_t plane = std::min(brick[0] * kBrickSide + x, lattice.last[0]);
        byte |= static_cast<unsigned>(double{row[lattice.sample(0, plane)]} > isovalue_) << x;
      }
      bits.rows[r] = static_cast<uint8_t>(byte);
    }
    signs.put(place, bits);
  }
  return signs;
}

template <int D>
void GridField<D>::quantize(Header& header, const Signs<D>& signs) const {
  const auto active = activeBricks(signs);
  double largest = 0;
  WholeSamples ones(1, isovalue_), bytes(255, isovalue_);
  Tube<D> tube;
  for (std::size_t place = 0; place < active.size(); ++place) {
    if (active[place] == 0) continue;
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
      if (members == Members::DiagonalEnds && header.polygonizer == Polygonizer::Cubes) break;
      tube.enter(signs, place, members);
      tube.forEach([&](int, std::size_t r, int x) {
        const double sample = samples_[at(vertex(tube.at(), r)) + static_cast<std::size_t>(x)];
        largest = std::max(largest, std::abs(sample - isovalue_));
        ones.see(sample);
        bytes.see(sample);
      });
    }
  }
  if (ones.all() && largest < double(1 << 28)) return header.countWhole(1);
  if (bytes.all() && largest <= 1) return header.countWhole(Header::kByteStep);
  header.quantum = std::ldexp(1.0, largest > 0 ? std::ilogb(largest) - 27 : 0);
}

template <int D>
uint32_t GridField<D>::magnitude(const Header& header, std::size_t place, std::size_t r, int x) const {
  if (place != lastPlace_) {
    lastPlace_ = place;
    lastStart_ = at(vertex(table_.brick(place), 0));
  }
  std::size_t sample = lastStart_ + static_cast<std::size_t>(x);
  for (int a = 1; a < D; ++a, r /= kBrickSide) sample += (r % kBrickSide) * stride_[a];
  double d = double{samples_[sample]} - isovalue_;
  if (header.quantum != 1) d /= header.quantum;
  if (header.whole) return static_cast<uint32_t>((d > 0 ? d - header.positiveOffset : -d - header.negativeOffset) + 0.5);
  return static_cast<uint32_t>(std::min(std::abs(d), double((1 << 29) - 1)));
}

template <int D>
int GridField<D>::gradient(const Header& header, std::size_t place) const {
  const auto brick = table_.brick(place);
  std::array<float, D * power(kBrickSide + 1, D)> differences;
  std::size_t count = 0;
  Coordinates<D> from, to;
  for (int a = 0; a < D; ++a) {
    from[a] = std::max(brick[a] * kBrickSide - 1, 0);
    to[a] = std::min(brick[a] * kBrickSide + kBrickSide - 1, last_[a]);
  }
  const auto isovalue = static_cast<float>(isovalue_);
  Coordinates<D> v = from;
  v[0] = 0;
  for (bool more = true; more;) {
    const float* row = &samples_[at(v)];
    std::array<std::size_t, D> next{1};
    for (int a = 1; a < D; ++a) next[a] = v[a] < last_[a] ? stride_[a] : 0;
    for (int32_t x = from[0]; x <= to[0]; ++x) {
      const float here = row[x];
      for (int a = 0; a < D; ++a) {
        const float there = row[static_cast<std::size_t>(x) + (a == 0 && x == last_[0] ? 0 : next[a])];
        if ((here > isovalue) != (there > isovalue)) differences[count++] = std::abs(here - there);
      }
    }
    int a = 1;
    for (; a < D && ++v[a] > to[a]; ++a) v[a] = from[a];
    more = a < D;
  }
  if (count == 0) return 0;
  std::nth_element(differences.begin(), differences.begin() + count / 2, differences.begin() + count);
  return static_cast<int>(std::clamp(std::lround(4 * std::log2(std::max(1.0, double{differences[count / 2]} / header.quantum))), 0L, 120L));
}

template bool sensible<2>(std::span<const float>, const Coordinates<2>&, double);
template bool sensible<3>(std::span<const float>, const Coordinates<3>&, double);
template bool sensible<4>(std::span<const float>, const Coordinates<4>&, double);
template class GridField<2>;
template class GridField<3>;
template class GridField<4>;

}  // namespace isostar
