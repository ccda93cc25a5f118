#include "bench/figure6/distance_samples.h"

#include <algorithm>

#include "volume/placement.h"

namespace isostar::bench {

DistanceSamples::DistanceSamples(const Volume& volume, double isovalue, const Signs<3>& signs,
                                 const measure::TriangleTree& surface)
    : volume_(volume),
      isovalue_(isovalue),
      signs_(signs),
      surface_(surface),
      unit_(volume.placement.spacing),
      known_(volume.samples.size(), -1.0f) {
  for (double& u : unit_) u /= native::smallestSpacing(volume.placement);
  if (surface.size() != 0) matchCrossings();
}

double DistanceSamples::operator()(const Coordinates<3>& sample) const {
  float& known = known_[index(sample)];
  if (known < 0) known = distance(sample);
  return signs_.at(sample) ? known : -known;
}

float DistanceSamples::distance(const Coordinates<3>& sample) const {
  constexpr float kLeast = 1e-4f;  // a sample on the surface keeps its sign
  if (surface_.size() == 0) return kLeast;
  const measure::Vector3 point{sample[0] * unit_[0], sample[1] * unit_[1], sample[2] * unit_[2]};
  return std::max(static_cast<float>(surface_.distance(point, near_)), kLeast);
}

/// A crossing is where the samples have it if distances are samples times the same factor at both
/// ends. The logarithms of these factors are therefore smoothed along crossing edges.
void DistanceSamples::matchCrossings() {
  constexpr int kRounds = 24;
  constexpr double kLeast = 1e-9;
  struct Edge {
    size_t from, to;
  };
  std::vector<Edge> edges;
  std::vector<size_t> ends;
  std::vector<float> factor(known_.size()), sum(known_.size());
  std::vector<uint8_t> degree(known_.size(), 1);  // by sample, itself included
  const auto size = [&](size_t end) {
    return std::max(std::abs(volume_.samples[end] - isovalue_), kLeast);
  };
  const auto add = [&](const Coordinates<3>& v) {
    const size_t end = index(v);
    if (degree[end]++ > 1) return end;
    ends.push_back(end);
    factor[end] = static_cast<float>(std::log(distance(v) / size(end)));
    return end;
  };
  for (int32_t z = 0; z < volume_.size[2]; ++z) {
    for (int32_t y = 0; y < volume_.size[1]; ++y) {
      for (int32_t x = 0; x < volume_.size[0]; ++x) {
        const Coordinates<3> from{x, y, z};
        for (int a = 0; a < 3; ++a) {
          auto to = from;
          if (++to[a] == volume_.size[a] || signs_.at(from) == signs_.at(to)) continue;
          const size_t first = add(from);
          edges.push_back({first, add(to)});
        }
      }
    }
  }
  for (int round = 0; round < kRounds; ++round) {
    for (size_t end : ends) sum[end] = factor[end];
    for (const Edge& e : edges) sum[e.from] += factor[e.to], sum[e.to] += factor[e.from];
    for (size_t end : ends) factor[end] = sum[end] / static_cast<float>(degree[end]);
  }
  for (size_t end : ends)
    known_[end] = static_cast<float>(size(end) * std::exp(double{factor[end]}));
}

}  // namespace isostar::bench
