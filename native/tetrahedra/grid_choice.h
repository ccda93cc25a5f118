#pragma once

#include <optional>
#include <string>

#include "tetrahedra/tetrahedral_field.h"
#include "volume/sample_grid.h"

namespace isostar::native {

/// A grid over the mesh's bounding box with `samples` along its longest side; without a number,
/// enough for two steps per typical crossing edge, but at most 513 before the following adjustment.
/// The steps on the axes may differ a little, so that flat parts of the domain's boundary (walls of
/// rooms) lie on planes of the grid if at most twice the samples per axis suffice. Throws a Failure
/// naming `path` if the grid is too large for the codec.
SampleGrid chooseGrid(const TetrahedralField&, double isovalue, std::optional<int> samples,
                      const std::string& path);

/// The same with steps of at most `step`.
SampleGrid gridOfStep(const TetrahedralField&, double step, const std::string& path);

/// Half the typical length of a crossing edge, within the limits of chooseGrid().
double suitableStep(const TetrahedralField&, double isovalue);

}  // namespace isostar::native
