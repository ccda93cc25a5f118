#include "bench/tetrahedra_rate.h"

#include "bench/draco_points.h"
#include "bench/isostar_codec.h"
#include "bench/stream_points.h"
#include "files/failure.h"
#include "files/input_file.h"
#include "tetrahedra/formats.h"
#include "tetrahedra/marching_tetrahedra.h"
#include "volume/placement.h"

namespace isostar::bench {
namespace {

using Json = nlohmann::ordered_json;

Json json(const measure::Distance& distance) {
  return {{"rms", distance.rms}, {"max", distance.max}};
}

/// World coordinates in steps of a grid, still at their place in the world.
void measureInSteps(Mesh& mesh, double step) {
  for (float& x : mesh.positions) x = static_cast<float>(x / step);
}

}  // namespace

Json tetrahedraRate(const TetrahedraRequest& request, const SizeOptions& options) {
  const std::vector<std::byte> stream = native::readFile(request.stream);
  const StreamInfo info = inspected(stream);
  const double step = native::smallestSpacing(info.placement);
  Mesh decoded,
      source = native::isosurfaceOf(native::readTetrahedra(request.path, {}), request.isovalue);
  require(decodeIsostar(stream).mesh({Polygonizer::Cubes, Frame::World, false}, decoded),
          "polygonize");
  measureInSteps(decoded, step);
  measureInSteps(source, step);
  const auto distance = measure::surfaceDistance(decoded, source);
  if (!distance) throw native::Failure(request.path, "no surface to compare");
  const Ruler ruler(source, options.points);
  return {{"size", info.size},
          {"step", step},
          {"bytes", stream.size()},
          {"bound", info.maxError},
          {"there", json(distance->aToB)},
          {"back", json(distance->bToA)},
          {"draco", dracoPoints(source, ruler)},
          {"simplified", simplifiedPoints(source, ruler)}};
}

}  // namespace isostar::bench
