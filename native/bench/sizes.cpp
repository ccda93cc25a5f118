#include "bench/sizes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/distance_meter.h"
#include "bench/draco_points.h"
#include "bench/general_codecs.h"
#include "bench/isostar_codec.h"
#include "bench/stream_points.h"

namespace isostar::bench {
namespace {

using Json = nlohmann::ordered_json;
using measure::Distance;

Json streamJson(const std::vector<std::byte>& stream) {
  const StreamInfo info = inspected(stream);
  std::map<bool, uint64_t> bits;  // true: of geometry
  Json layers = Json::array();
  for (const LayerInfo& layer : info.layers) {
    bits[layer.kind == "geometry"] += 8 * layer.bytes;
    layers.push_back(layerJson(layer));
  }
  return {
      {"bytes", stream.size()},
      {"bits",
       {{"connectivity", bits[false]}, {"geometry", bits[true]}, {"header", 8 * info.headerBytes}}},
      {"layers", layers}};
}

/// Compares the decoded surface with the source's: whether the triangles are the same, and the
/// largest difference of a coordinate.
Json losslessJson(const Subject& subject) {
  const std::vector<std::byte> stream = encodeIsostarLossless(subject);
  const Mesh mesh = decodedMesh(stream, subject);
  const bool same = mesh.indices == subject.mesh.indices &&
                    mesh.positions.size() == subject.mesh.positions.size();
  double worst = 0;
  for (size_t i = 0; same && i < mesh.positions.size(); ++i)
    worst = std::max(worst, std::abs(double{mesh.positions[i]} - subject.mesh.positions[i]));
  Json json = streamJson(stream);
  json["sameTriangles"] = same;
  json["largestDifference"] = same ? Json(worst) : Json();
  return json;
}

Json meshopt(const Mesh& mesh, const DistanceMeter& meter) {
  Json points = Json::array();
  for (int bits : positionBits(mesh, 2, 14)) {
    const MeshoptStream stream = encodeMeshopt(mesh, bits);
    points.push_back(point(stream.bytes, meter.distance(stream.decoded)));
    points.back()["bits"] = bits;
  }
  return points;
}

}  // namespace

Json sizes(const Subject& subject, const SizeOptions& options) {
  Json json = {{"size", subject.volume.size},
               {"spacing", subject.volume.placement.spacing},
               {"isovalue", subject.isovalue},
               {"vertices", subject.mesh.positions.size() / 3},
               {"triangles", subject.mesh.indices.size() / 3}};
  if (subject.mesh.indices.empty()) return json;
  const DistanceMeter meter(subject.mesh, options.points);
  const double bound = EncodeOptions{}.maxError;
  const std::vector<std::byte> stream = encodeIsostar(subject, bound);
  json["default"] = streamJson(stream);
  json["default"]["bound"] = bound;
  if (const auto distance = meter.thoroughDistance(decodedMesh(stream, subject)))
    json["default"]["rms"] = distance->rms, json["default"]["max"] = distance->max;
  json["prefixes"] = prefixes(stream, subject, meter, options.prefixes);
  json["lossless"] = losslessJson(subject);
  json["draco"] = dracoPoints(subject.mesh, meter);
  json["bounds"] = otherBounds(subject, meter);
  if (!options.rate) return json;
  json["simplified"] = simplifiedPoints(subject.mesh, meter);
  json["meshopt"] = meshopt(subject.mesh, meter);
  json["zstdVolume"] = zstdBytes(subject.volume.samples);
  return json;
}

}  // namespace isostar::bench
