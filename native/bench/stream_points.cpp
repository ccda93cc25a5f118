#include "bench/stream_points.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/isostar_codec.h"

namespace isostar::bench {

using Json = nlohmann::ordered_json;
using measure::Distance;

namespace {

constexpr double kOtherBounds[] = {0.4, 0.2, 0.1, 0.025, 0.0125};
constexpr double kShares[] = {0.02, 0.05, 0.1};  // of a stream: low rates are compared there

Mesh meshInGridSteps(const Decoder& decoder, const Subject& subject) {
  Mesh mesh = meshOf(decoder, false);
  toGridSteps(mesh, subject.volume.placement);
  return mesh;
}

std::set<size_t> prefixSizes(const StreamInfo& info, int steps) {
  const double all = static_cast<double>(info.bytes);
  std::set<size_t> sizes;
  for (const LayerInfo& layer : info.layers) sizes.insert({layer.offset - 1, layer.offset});
  for (double share : kShares) sizes.insert(static_cast<size_t>(share * all));
  for (int i = 1; i < steps; ++i)
    sizes.insert(static_cast<size_t>(all * std::pow(kShares[0], static_cast<double>(i) / steps)));
  return sizes;
}

}  // namespace

Json layerJson(const LayerInfo& layer) {
  return {{"kind", layer.kind},
          {"level", layer.level},
          {"offset", layer.offset},
          {"bytes", layer.bytes},
          {"error", layer.error}};
}

Json point(size_t bytes, const std::optional<Distance>& distance) {
  Json json = {{"bytes", bytes}, {"rms", nullptr}, {"max", nullptr}};
  if (distance) json["rms"] = distance->rms, json["max"] = distance->max;
  return json;
}

StreamInfo inspected(const std::vector<std::byte>& stream) {
  StreamInfo info;
  require(inspect(stream, info), "inspect");
  return info;
}

Mesh decodedMesh(const std::vector<std::byte>& stream, const Subject& subject) {
  return meshInGridSteps(decodeIsostar(stream), subject);
}

Json prefixes(const std::vector<std::byte>& stream, const Subject& subject,
              const DistanceMeter& meter, int steps) {
  const StreamInfo info = inspected(stream);
  Json points = Json::array();
  std::optional<Distance> distance;
  uint64_t shown = 0;
  for (size_t bytes : prefixSizes(info, steps)) {
    const Decoder decoder = decodeIsostar(std::span(stream).first(bytes));
    if (decoder.level() < 0) continue;  // no surface yet
    if (decoder.bytes() != shown) distance = meter.distance(meshInGridSteps(decoder, subject));
    shown = decoder.bytes();
    Json json = point(bytes, distance);
    json["layerEnd"] = std::ranges::any_of(
        info.layers, [&](const LayerInfo& layer) { return layer.offset == bytes; });
    points.push_back(json);
  }
  return points;
}

Json otherBounds(const Subject& subject, const DistanceMeter& meter) {
  Json points = Json::array();
  for (double bound : kOtherBounds) {
    const std::vector<std::byte> stream = encodeIsostar(subject, bound);
    points.push_back(point(stream.size(), meter.distance(decodedMesh(stream, subject))));
    points.back()["maxError"] = bound;
  }
  return points;
}

}  // namespace isostar::bench
