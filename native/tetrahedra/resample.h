#pragma once

#include <functional>
#include <vector>

#include "tetrahedra/sample_grid.h"
#include "tetrahedra/tetrahedral_field.h"

namespace isostar::native {

/// A tetrahedral field on a grid (x fastest), and where it ends.
struct ResampledField {
  std::vector<float> samples;  // beyond the domain they go on: see TetrahedralField::beyond()
  std::vector<float>
      domain;  // see Volume, at most ±kDomainBand; empty: it ends where the grid does
};

inline constexpr float kDomainBand =
    8;  // smallest steps: more than a cell's diagonal on any grid of gridOver()

/// `progress` is called now and then with 0 … 1, by any thread, one at a time.
ResampledField resample(const TetrahedralField&, const SampleGrid&,
                        const std::function<void(double)>& progress);

}  // namespace isostar::native
