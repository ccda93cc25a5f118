#include "bench/distance_meter.h"

#include <limits>

namespace isostar::bench {
namespace {

std::optional<measure::Distance> measured(const Mesh& mesh, const measure::Measurable& source,
                                          size_t points) {
  if (mesh.indices.empty()) return {};
  return measure::surfaceDistance(measure::Measurable(mesh), source, points).symmetric();
}

}  // namespace

std::optional<measure::Distance> DistanceMeter::distance(const Mesh& mesh) const {
  return measured(mesh, source_, points_);
}

std::optional<measure::Distance> DistanceMeter::thoroughDistance(const Mesh& mesh) const {
  return measured(mesh, source_, std::numeric_limits<size_t>::max());
}

}  // namespace isostar::bench
