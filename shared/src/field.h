// The source as questions: signs on an octave, scalars on the finest (§3, definitions). Only the encoder has one.
#pragma once

#include <vector>

#include "bricks.h"
#include "isostar/isostar.h"
#include "stream.h"

namespace isostar {

/// Is there a surface to ask for? As many samples as the size says, all finite, and a placement with an inverse.
[[nodiscard]] bool sensible(const Volume& volume, double isovalue);

class VolumeField {
 public:
  VolumeField(const Volume& volume, double isovalue) : samples_(volume.samples), isovalue_(isovalue) {
    for (int a = 0; a < 3; ++a) last_[a] = volume.size[a] - 1;
    stride_ = {1, static_cast<std::size_t>(volume.size[0]), static_cast<std::size_t>(volume.size[0]) * static_cast<std::size_t>(volume.size[1])};
    table_ = BrickTable<3>(Lattice<3>(last_, 1));
  }

  [[nodiscard]] double scalar(const Coordinates<3>& sample) const { return double{samples_[at(sample)]} - isovalue_; }
  [[nodiscard]] const Coordinates<3>& last() const { return last_; }

  /// Signs on the octave whose planes lie `step` samples apart.
  [[nodiscard]] Signs<3> signs(int32_t step) const;

  /// Fixes what a quantum is, for |scalars| up to the largest at the end of a crossing edge of the RBMT.
  void quantize(Header& header, const Signs<3>& signs) const;

  /// In quanta of a header.
  [[nodiscard]] uint32_t magnitude(const Header& header, std::size_t place, std::size_t r, int x) const;
  /// The median difference along the crossing axis edges of a brick, 4 log2 of quanta.
  [[nodiscard]] int gradient(const Header& header, std::size_t place) const;

 private:
  [[nodiscard]] std::size_t at(const Coordinates<3>& v) const {
    return static_cast<std::size_t>(v[0]) + static_cast<std::size_t>(v[1]) * stride_[1] + static_cast<std::size_t>(v[2]) * stride_[2];
  }

  std::span<const float> samples_;
  double isovalue_;
  Coordinates<3> last_{};
  std::array<std::size_t, 3> stride_{};
  BrickTable<3> table_;
  // The brick that magnitude() was asked of last, and its first sample: bricks are asked one after the other.
  mutable std::size_t lastPlace_ = SIZE_MAX, lastStart_ = 0;
};

/// A field's scalars as the quanta of one stream, and the bricks selected for a pass, by place.
class QuantizedField {
 public:
  QuantizedField(const VolumeField& field, const Header& header) : field_(field), header_(header) {}
  void select(std::vector<uint8_t> places) { selected_ = std::move(places); }
  [[nodiscard]] uint32_t magnitude(std::size_t place, std::size_t r, int x) const { return field_.magnitude(header_, place, r, x); }
  [[nodiscard]] int gradient(std::size_t place) const { return field_.gradient(header_, place); }
  [[nodiscard]] bool selected(std::size_t place) const { return selected_[place] != 0; }

 private:
  const VolumeField& field_;
  const Header& header_;
  std::vector<uint8_t> selected_;
};

}  // namespace isostar
