#pragma once

#include <vector>

#include "isostar/isostar.h"
#include "tetrahedra/sample_grid.h"

namespace isostar::native {

/// Samples (x fastest) of a field that is bent wherever one tetrahedron follows another become
/// distances to the isosurface, which are linear where that is flat: marching cubes places its
/// vertices nearer to it, and fewer bytes tell them. No sample changes its sign against the
/// isovalue; distances are counted from it, up to a few steps.
void becomeDistances(const Mesh& isosurface, double isovalue, const SampleGrid&,
                     std::vector<float>& samples);

}  // namespace isostar::native
