#include "bench/sizes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/draco_points.h"
#include "bench/general_codecs.h"
#include "bench/isostar_codec.h"
#include "bench/ruler.h"
#include "bench/stream_points.h"

namespace isostar::bench {
namespace {

using Json = nlohmann::ordered_json;
using measure::Distance;

Json streamJson(const std::vector<std::byte>& stream) {
  const StreamInfo info = inspected(stream);
  std::map<bool, uint64_t> bits;  // of geometry or not
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

/// The decoded surface against the polygonizer's own: the same triangles, and how far a coordinate
/// is off at most.
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

Json meshopt(const Mesh& mesh, const Ruler& ruler) {
  Json points = Json::array();
  for (int bits : positionBits(mesh, 2, 14)) {
    const MeshoptStream stream = encodeMeshopt(mesh, bits);
    points.push_back(point(stream.bytes, ruler.distance(stream.decoded)));
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
  const Ruler ruler(subject.mesh, options.points);
  const double bound = EncodeOptions{}.maxError;
  const std::vector<std::byte> stream = encodeIsostar(subject, bound);
  json["default"] = streamJson(stream);
  json["default"]["bound"] = bound;
  if (const auto distance = ruler.thoroughDistance(decodedMesh(stream, subject)))
    json["default"]["rms"] = distance->rms, json["default"]["max"] = distance->max;
  json["prefixes"] = prefixes(stream, subject, ruler, options.prefixes);
  json["lossless"] = losslessJson(subject);
  json["draco"] = dracoPoints(subject.mesh, ruler);
  json["bounds"] = otherBounds(subject, ruler);
  if (!options.rate) return json;
  json["simplified"] = simplifiedPoints(subject.mesh, ruler);
  json["meshopt"] = meshopt(subject.mesh, ruler);
  json["zstdVolume"] = zstdBytes(subject.volume.samples);
  return json;
}

}  // namespace isostar::bench
