#include "bench/draco_points.h"

#include <algorithm>
#include <cmath>

#include "bench/draco_codec.h"
#include "bench/simplifier.h"
#include "bench/stream_points.h"

namespace isostar::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr double kRatios[] = {0.85, 0.7,  0.5,   0.36, 0.26, 0.18,  0.13,
                              0.09, 0.06, 0.035, 0.02, 0.01, 0.005, 0.0025};
constexpr double kCoarse = 0.05;  // the ratio below which larger steps are tested too

Json dracoPoint(const Mesh& mesh, int level, int bits, const DistanceMeter& meter) {
  const std::vector<std::byte> bytes = encodeDraco(mesh, level, bits);
  Json json = point(bytes.size(), meter.distance(meshOfDraco(bytes)));
  json["level"] = level;
  json["bits"] = bits;
  return json;
}

}  // namespace

std::vector<int> positionBits(const Mesh& mesh, double coarsestStep, int most) {
  float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY},
        side = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], mesh.positions[i]);
    high[i % 3] = std::max(high[i % 3], mesh.positions[i]);
  }
  for (int axis = 0; axis < 3; ++axis) side = std::max(side, high[axis] - low[axis]);
  std::vector<int> bits;
  for (int b = std::clamp(static_cast<int>(std::ceil(std::log2(side / coarsestStep))), 2, 8);
       b <= most; ++b)
    bits.push_back(b);
  return bits;
}

Json dracoPoints(const Mesh& mesh, const DistanceMeter& meter) {
  Json points = Json::array();
  for (int bits : positionBits(mesh, 2, 14)) {
    Json best = dracoPoint(mesh, 10, bits, meter);
    Json quick = best;
    quick["bytes"] = encodeDraco(mesh, 7, bits).size();
    quick["level"] = 7;
    points.push_back(best);
    points.push_back(quick);
  }
  return points;
}

Json simplifiedPoints(const Mesh& mesh, const DistanceMeter& meter) {
  Json points = Json::array();
  for (double ratio : kRatios) {
    const Mesh fewer = simplified(mesh, ratio);
    if (fewer.indices.empty()) break;
    for (int bits : positionBits(mesh, ratio < kCoarse ? 4 : 2, 13)) {
      points.push_back(dracoPoint(fewer, 10, bits, meter));
      points.back()["ratio"] = ratio;
    }
  }
  return points;
}

}  // namespace isostar::bench
