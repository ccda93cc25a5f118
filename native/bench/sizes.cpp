#include "bench/sizes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/draco_codec.h"
#include "bench/general_codecs.h"
#include "bench/isostar_codec.h"
#include "bench/ruler.h"
#include "bench/simplifier.h"
#include "bench/stream_points.h"

namespace isostar::bench {
namespace {

using Json = nlohmann::ordered_json;
using measure::Distance;

constexpr double kOtherBounds[] = {0.4, 0.2, 0.1, 0.025, 0.0125};
constexpr double kRatios[] = {0.85, 0.7, 0.5, 0.36, 0.26, 0.18, 0.13, 0.09, 0.06, 0.035, 0.02, 0.01, 0.005, 0.0025};
constexpr double kCoarse = 0.05;                 // ratio below which larger steps pay, too

Json layerJson(const LayerInfo& layer) {
  return {{"kind", layer.kind},
          {"level", layer.level},
          {"offset", layer.offset},
          {"bytes", layer.bytes},
          {"error", layer.error}};
}

Json streamJson(const std::vector<std::byte>& stream) {
  const StreamInfo info = inspected(stream);
  std::map<bool, uint64_t> bits;  // of geometry or not
  Json layers = Json::array();
  for (const LayerInfo& layer : info.layers) {
    bits[layer.kind == "geometry"] += 8 * layer.bytes;
    layers.push_back(layerJson(layer));
  }
  return {{"bytes", stream.size()},
          {"bits", {{"connectivity", bits[false]}, {"geometry", bits[true]}, {"header", 8 * info.headerBytes}}},
          {"layers", layers}};
}

/// The decoded surface against the polygonizer's own: the same triangles, and how far a coordinate is off at most.
Json losslessJson(const Subject& subject) {
  const std::vector<std::byte> stream = encodeIsostarLossless(subject);
  const Mesh mesh = decodedMesh(stream, subject);
  const bool same = mesh.triangles == subject.mesh.triangles && mesh.positions.size() == subject.mesh.positions.size();
  double worst = 0;
  for (size_t i = 0; same && i < mesh.positions.size(); ++i)
    worst = std::max(worst, std::abs(double{mesh.positions[i]} - subject.mesh.positions[i]));
  Json json = streamJson(stream);
  json["sameTriangles"] = same;
  json["largestDifference"] = same ? Json(worst) : Json();
  return json;
}

/// From 8, or from the count that gives Draco the coarsest step where that is smaller, to `most`.
std::vector<int> dracoBits(const Mesh& mesh, double coarsestStep, int most) {
  float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, side = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], mesh.positions[i]);
    high[i % 3] = std::max(high[i % 3], mesh.positions[i]);
  }
  for (int axis = 0; axis < 3; ++axis) side = std::max(side, high[axis] - low[axis]);
  std::vector<int> bits;
  for (int b = std::clamp(static_cast<int>(std::ceil(std::log2(side / coarsestStep))), 2, 8); b <= most; ++b)
    bits.push_back(b);
  return bits;
}

Json dracoPoint(const Mesh& mesh, int level, int bits, const Ruler& ruler) {
  const std::vector<std::byte> bytes = encodeDraco(mesh, level, bits);
  Json json = point(bytes.size(), ruler.distance(meshOfDraco(bytes)));
  json["level"] = level;
  json["bits"] = bits;
  return json;
}

/// Both levels round to the same positions, so that one distance counts for both.
Json draco(const Mesh& mesh, const Ruler& ruler) {
  Json points = Json::array();
  for (int bits : dracoBits(mesh, 2, 14)) {
    Json best = dracoPoint(mesh, 10, bits, ruler);
    Json quick = best;
    quick["bytes"] = encodeDraco(mesh, 7, bits).size();
    quick["level"] = 7;
    points.push_back(best);
    points.push_back(quick);
  }
  return points;
}

Json simplifiedDraco(const Mesh& mesh, const Ruler& ruler) {
  Json points = Json::array();
  for (double ratio : kRatios) {
    const Mesh fewer = simplified(mesh, ratio);
    if (fewer.triangles.empty()) break;
    for (int bits : dracoBits(mesh, ratio < kCoarse ? 4 : 2, 13)) {
      points.push_back(dracoPoint(fewer, 10, bits, ruler));
      points.back()["ratio"] = ratio;
    }
  }
  return points;
}

Json meshopt(const Mesh& mesh, const Ruler& ruler) {
  Json points = Json::array();
  for (int bits : dracoBits(mesh, 2, 14)) {
    const MeshoptStream stream = encodeMeshopt(mesh, bits);
    points.push_back(point(stream.bytes, ruler.distance(stream.decoded)));
    points.back()["bits"] = bits;
  }
  return points;
}

Json otherBounds(const Subject& subject, const Ruler& ruler) {
  Json points = Json::array();
  for (double bound : kOtherBounds) {
    const std::vector<std::byte> stream = encodeIsostar(subject, bound);
    points.push_back(point(stream.size(), ruler.distance(decodedMesh(stream, subject))));
    points.back()["maxError"] = bound;
  }
  return points;
}

}  // namespace

Json sizes(const Subject& subject, const SizeOptions& options) {
  Json json = {{"size", subject.volume.size},
               {"spacing", subject.volume.placement.spacing},
               {"isovalue", subject.isovalue},
               {"vertices", subject.mesh.positions.size() / 3},
               {"triangles", subject.mesh.triangles.size() / 3}};
  if (subject.mesh.triangles.empty()) return json;
  const Ruler ruler(subject.mesh, options.points);
  const double bound = EncodeOptions{}.maxError;
  const std::vector<std::byte> stream = encodeIsostar(subject, bound);
  json["default"] = streamJson(stream);
  json["default"]["bound"] = bound;
  if (const auto distance = ruler.thoroughDistance(decodedMesh(stream, subject)))
    json["default"]["rms"] = distance->rms, json["default"]["max"] = distance->max;
  json["prefixes"] = prefixes(stream, subject, ruler, options.prefixes);
  json["lossless"] = losslessJson(subject);
  json["draco"] = draco(subject.mesh, ruler);
  json["bounds"] = otherBounds(subject, ruler);
  if (!options.rate) return json;
  json["simplified"] = simplifiedDraco(subject.mesh, ruler);
  json["meshopt"] = meshopt(subject.mesh, ruler);
  json["zstdVolume"] = zstdBytes(subject.volume.samples);
  return json;
}

}  // namespace isostar::bench
