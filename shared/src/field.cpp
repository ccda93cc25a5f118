#include "field.h"

#include <algorithm>
#include <cmath>

#include "octave.h"
#include "tube.h"

namespace isostar {

bool sensible(const Volume& volume, double isovalue) {
  uint64_t samples = 1;
  for (int32_t n : volume.size) {
    if (n < 1 || n >= (1 << 28)) return false;
    samples *= static_cast<uint64_t>(n);
    if (samples > volume.samples.size()) return false;
  }
  return samples == volume.samples.size() && std::isfinite(isovalue) && invertible(volume.placement) &&
         std::ranges::all_of(volume.samples, [](float s) { return std::isfinite(s); });
}

Signs<3> VolumeField::signs(int32_t step) const {
  const Lattice<3> lattice(last_, step);
  Signs<3> signs(lattice);
  // A box without extent on an axis has no cells, and so no surface.
  if (std::ranges::any_of(last_, [](int32_t last) { return last == 0; })) return signs;
  const auto& table = signs.table();
  for (std::size_t place = 0; place < table.total(); ++place) {
    const auto brick = table.brick(place);
    Brick<3> bits;
    for (int r = 0; r < 64; ++r) {
      // Beyond the lattice the last plane goes on, so that a uniform brick at the box's end is one.
      const int32_t y = std::min(brick[1] * kBrickSide + r % 8, lattice.last[1]);
      const int32_t z = std::min(brick[2] * kBrickSide + r / 8, lattice.last[2]);
      const float* row = &samples_[at({0, lattice.sample(1, y), lattice.sample(2, z)})];
      unsigned byte = 0;
      for (int x = 0; x < kBrickSide; ++x) {
        const int32_t plane = std::min(brick[0] * kBrickSide + x, lattice.last[0]);
        byte |= static_cast<unsigned>(double{row[lattice.sample(0, plane)]} > isovalue_) << x;
      }
      bits.rows[static_cast<std::size_t>(r)] = static_cast<uint8_t>(byte);
    }
    signs.put(place, bits);
  }
  return signs;
}

void VolumeField::quantize(Header& header, const Signs<3>& signs) const {
  const auto active = activeBricks(signs);
  double largest = 0;
  bool whole = true;
  Tube<3> tube;
  for (std::size_t place = 0; place < active.size(); ++place) {
    if (active[place] == 0) continue;
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
      if (members == Members::DiagonalEnds && header.polygonizer == Polygonizer::Cubes) break;
      tube.enter(signs, place, members);
      const auto& brick = tube.at();
      tube.forEach([&](int, std::size_t r, int x) {
        const Coordinates<3> v{brick[0] * 8 + x, brick[1] * 8 + static_cast<int32_t>(r % 8), brick[2] * 8 + static_cast<int32_t>(r / 8)};
        const double sample = samples_[at(v)];
        largest = std::max(largest, std::abs(sample - isovalue_));
        whole = whole && sample == std::floor(sample);
      });
    }
  }
  if (whole && largest < double(1 << 28)) {
    header.quantum = 1;
    header.positiveOffset = std::floor(isovalue_) + 1 - isovalue_;
    header.negativeOffset = isovalue_ - std::floor(isovalue_);
    return;
  }
  // A quantum of 1 marks samples that are whole numbers: keep clear of it.
  const double quantum = std::ldexp(largest, -28);
  header.quantum = quantum == 1 ? 0.5 : quantum;
  header.positiveOffset = header.negativeOffset = 0.5;
}

uint32_t VolumeField::magnitude(const Header& header, std::size_t place, std::size_t r, int x) const {
  if (place != lastPlace_) {
    const auto brick = table_.brick(place);
    lastPlace_ = place;
    lastStart_ = at({brick[0] * kBrickSide, brick[1] * kBrickSide, brick[2] * kBrickSide});
  }
  const double d = double{samples_[lastStart_ + static_cast<std::size_t>(x) + (r % kBrickSide) * stride_[1] + (r / kBrickSide) * stride_[2]]} - isovalue_;
  if (header.quantum == 1) return static_cast<uint32_t>((d > 0 ? d - header.positiveOffset : -d - header.negativeOffset) + 0.5);
  return static_cast<uint32_t>(std::min(std::abs(d) / header.quantum, double((1 << 29) - 1)));
}

int VolumeField::gradient(const Header& header, std::size_t place) const {
  const auto brick = table_.brick(place);
  std::array<float, 3 * 729> differences;
  std::size_t count = 0;
  Coordinates<3> from, to;
  for (int a = 0; a < 3; ++a) {
    from[a] = std::max(brick[a] * 8 - 1, 0);
    to[a] = std::min(brick[a] * 8 + 7, last_[a]);
  }
  const auto isovalue = static_cast<float>(isovalue_);
  for (int32_t z = from[2]; z <= to[2]; ++z) {
    for (int32_t y = from[1]; y <= to[1]; ++y) {
      const float* row = &samples_[at({0, y, z})];
      const std::array<std::ptrdiff_t, 3> next{1, y < last_[1] ? static_cast<std::ptrdiff_t>(stride_[1]) : 0,
                                               z < last_[2] ? static_cast<std::ptrdiff_t>(stride_[2]) : 0};
      for (int32_t x = from[0]; x <= to[0]; ++x) {
        const float here = row[x];
        for (std::size_t a = 0; a < 3; ++a) {
          const float there = row[x + (a == 0 && x == last_[0] ? 0 : next[a])];
          if ((here > isovalue) != (there > isovalue)) differences[count++] = std::abs(here - there);
        }
      }
    }
  }
  if (count == 0) return 0;
  std::nth_element(differences.begin(), differences.begin() + count / 2, differences.begin() + count);
  return static_cast<int>(std::clamp(std::lround(4 * std::log2(std::max(1.0, double{differences[count / 2]} / header.quantum))), 0L, 120L));
}

}  // namespace isostar
