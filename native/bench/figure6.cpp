#include "bench/figure6.h"

#include "bench/figure6/octree_codec.h"
#include "bench/figure6/single_rate_codec.h"
#include "bench/isostar_codec.h"
#include "bench/stream_points.h"
#include "volume/placement.h"

namespace isostar::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kUniformBounds[] = {0.4, 0.2, 0.1, 0.05, 0.025};
constexpr double kAdaptiveBounds[] = {0.8, 0.4, 0.2, 0.1};
constexpr double kSingleRateBounds[] = {1.6, 0.8, 0.4, 0.2, 0.1, 0.05};

Json uniform(const Subject& subject, const DistanceMeter& meter) {
  Json points = Json::array();
  for (double bound : kUniformBounds) {
    const auto stream = encodeIsostar(subject, bound);
    points.push_back(point(stream.size(), meter.distance(decodedMesh(stream, subject))));
    points.back()["maxError"] = bound;
  }
  return points;
}

/// Skips bounds at which the uniform stream is smaller.
Json adaptive(const Subject& subject, const DistanceMeter& meter) {
  Json points = Json::array();
  for (double bound : kAdaptiveBounds) {
    const auto stream = encodeIsostarAdaptive(subject, bound);
    if (!inspected(stream).adaptive) continue;
    points.push_back(point(stream.size(), meter.distance(decodedMesh(stream, subject))));
    points.back()["maxError"] = bound;
  }
  return points;
}

Json singleRate(const Subject& subject, const measure::TriangleTree& surface,
                const DistanceMeter& meter) {
  Json points = Json::array();
  for (const auto& stream :
       encodeSingleRate(subject.volume.view(), subject.isovalue, surface, kSingleRateBounds)) {
    const SampledFunction function = decodeSingleRate(stream.bytes);
    Mesh mesh = surfaceOf(function);
    toGridSteps(mesh, subject.volume.placement);
    Json json = point(stream.bytes.size(), meter.distance(mesh));
    json["connectivity"] = stream.connectivity;
    json["leaves"] = stream.leaves;
    json["vertices"] = stream.vertices;
    points.push_back(json);
  }
  return points;
}

Json octree(const Subject& subject, const measure::TriangleTree& surface,
            const DistanceMeter& meter) {
  std::array<double, 3> unit = subject.volume.placement.spacing;
  for (double& u : unit) u /= native::smallestSpacing(subject.volume.placement);
  const auto stream = encodeOctree(subject.volume.view(), subject.isovalue, surface);
  const auto shown = [&](size_t bytes) {
    return point(bytes, meter.distance(decodeOctree(std::span(stream).first(bytes), unit)));
  };
  Json points = Json::array();
  size_t before = 0;
  for (const auto& [end, signs] : octreeLayers(stream)) {
    if (signs && before != 0) points.push_back(points.back()), points.back()["bytes"] = end - 1;
    if (!signs) points.push_back(shown(before + (end - before) / 2));
    if (before != 0) points.back()["layerEnd"] = false;
    points.push_back(shown(end));
    points.back()["layerEnd"] = true;
    before = end;
  }
  return points;
}

}  // namespace

Json figure6(const Subject& subject, const Figure6Options& options) {
  Json json = {{"isovalue", subject.isovalue}, {"vertices", subject.mesh.positions.size() / 3}};
  if (subject.mesh.indices.empty()) return json;
  const DistanceMeter meter(subject.mesh, options.points);
  const measure::TriangleTree surface(subject.mesh);
  json["prefixes"] =
      prefixes(encodeIsostar(subject, EncodeOptions{}.maxError), subject, meter, options.prefixes);
  json["uniform"] = uniform(subject, meter);
  json["adaptive"] = adaptive(subject, meter);
  json["singleRate"] = singleRate(subject, surface, meter);
  json["octree"] = octree(subject, surface, meter);
  return json;
}

}  // namespace isostar::bench
