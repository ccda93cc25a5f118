#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "bench/ruler.h"

namespace isostar::bench {

/// Bits of a position that are worth a try: from 8, or from as few as make the coarsest step where
/// these are fewer, to `most`. The step is in the mesh's unit.
std::vector<int> positionBits(const Mesh&, double coarsestStep, int most);

/// What Draco makes of a mesh at levels 7 and 10, which round to the same positions, so that one
/// distance counts for both. The unit of the mesh is a grid step.
nlohmann::ordered_json dracoPoints(const Mesh&, const Ruler&);

/// The same at level 10 of meshes with fewer triangles.
nlohmann::ordered_json simplifiedPoints(const Mesh&, const Ruler&);

}  // namespace isostar::bench
