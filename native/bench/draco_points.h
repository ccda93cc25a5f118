#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "bench/distance_meter.h"

namespace isostar::bench {

/// The numbers of position bits to test: from 8, or from those of the coarsest step if they are
/// fewer, to `most`. The step is in the mesh's unit.
std::vector<int> positionBits(const Mesh&, double coarsestStep, int most);

/// Rate-distortion points of Draco at levels 7 and 10. Both round to the same positions, so one
/// distance is measured for both. The unit of the mesh is a grid step.
nlohmann::ordered_json dracoPoints(const Mesh&, const DistanceMeter&);

/// The same at level 10, for simplified meshes.
nlohmann::ordered_json simplifiedPoints(const Mesh&, const DistanceMeter&);

}  // namespace isostar::bench
