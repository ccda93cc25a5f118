#pragma once

#include <functional>
#include <vector>

#include "tetrahedra/tetrahedral_field.h"
#include "volume/sample_grid.h"

namespace isostar::native {

/// A tetrahedral field on a grid (x fastest), and the boundary of its domain.
struct ResampledField {
  std::vector<float> samples;  // beyond the domain as TetrahedralField::beyond() continues it
  std::vector<float> domain;   // see Volume, at most ±kDomainBand; empty if the domain is the box
};

/// In smallest steps: more than a cell's diagonal on any grid of chooseGrid().
inline constexpr float kDomainBand = 8;

/// `progress` is called with 0 … 1 by any thread, one at a time.
ResampledField resample(const TetrahedralField&, const SampleGrid&,
                        const std::function<void(double)>& progress);

}  // namespace isostar::native
