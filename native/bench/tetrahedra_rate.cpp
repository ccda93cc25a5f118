#include "bench/tetrahedra_rate.h"

#include "bench/draco_points.h"
#include "bench/isostar_codec.h"
#include "bench/stream_points.h"
#include "files/failure.h"
#include "files/input_file.h"
#include "tetrahedra/marching_tetrahedra.h"
#include "tetrahedra/tetrahedra_reader.h"
#include "volume/placement.h"

namespace isostar::bench {
namespace {

using Json = nlohmann::ordered_json;

Json json(const measure::Distance& distance) {
  return {{"rms", distance.rms}, {"max", distance.max}};
}

/// Scales world coordinates to grid steps; the origin stays that of the world.
void scaleToSteps(Mesh& mesh, double step) {
  for (float& x : mesh.positions) x = static_cast<float>(x / step);
}

}  // namespace

Json tetrahedraRate(const TetrahedraRequest& request, const SizeOptions& options) {
  const std::vector<std::byte> stream = native::readFile(request.stream);
  const StreamInfo info = inspected(stream);
  const double step = native::smallestSpacing(info.placement);
  Mesh decoded,
      source = native::isosurfaceOf(native::readTetrahedra(request.path, {}), request.isovalue);
  require(decodeIsostar(stream).mesh({.normals = false}, decoded), "polygonize");
  scaleToSteps(decoded, step);
  scaleToSteps(source, step);
  const auto distance = measure::surfaceDistance(decoded, source);
  if (!distance) throw native::Failure(request.path, "has no surface to compare");
  const DistanceMeter meter(source, options.points);
  return {{"size", info.size},
          {"step", step},
          {"bytes", stream.size()},
          {"bound", info.maxError},
          {"there", json(distance->aToB)},
          {"back", json(distance->bToA)},
          {"draco", dracoPoints(source, meter)},
          {"simplified", simplifiedPoints(source, meter)}};
}

}  // namespace isostar::bench
