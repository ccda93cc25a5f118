#pragma once

#include <optional>
#include <string>

#include "tetrahedra/sample_grid.h"
#include "tetrahedra/tetrahedral_field.h"

namespace isostar::native {

/// A grid whose ends are those of the mesh's bounding box, `samples` along its longest side;
/// without a number, at least as many as give two steps to the typical edge that the isosurface
/// crosses, 513 being enough. Steps on the axes differ by little, so that flat parts of the
/// domain's boundary, the walls of rooms, come to lie on planes of the grid where that is possible
/// at no more than twice the samples. Fails with one line naming `path` where the codec cannot hold
/// it.
SampleGrid gridOver(const TetrahedralField&, double isovalue, std::optional<int> samples,
                    const std::string& path);

/// The same without a number, of steps no longer than this one.
SampleGrid gridOfSteps(const TetrahedralField&, double step, const std::string& path);

/// Half the typical edge that the isosurface crosses, within what gridOver() chooses of its own.
double suitableStep(const TetrahedralField&, double isovalue);

}  // namespace isostar::native
