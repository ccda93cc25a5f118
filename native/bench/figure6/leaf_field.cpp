#include "bench/figure6/leaf_field.h"

namespace isostar::bench {

void LeafField::fill(const TaggedSimplex<3>& s, const LinearFunction<3>& linear) {
  for (const auto& v : s.vertices) {
    const auto sample = hierarchy_.position(v);
    samples_[index(sample)] = static_cast<float>(linear.at(sample));
  }
  if (s.depth == hierarchy_.maxDepth()) return;
  for (const auto& half : s.halves()) {
    if (!hierarchy_.flat(half.vertices)) fill(half, linear);
  }
}

void LeafField::complete(bool positive) {
  const auto& box = hierarchy_.box();
  std::vector<Coordinates<3>> front;
  for (int32_t z = 0; z <= box[2]; ++z) {
    for (int32_t y = 0; y <= box[1]; ++y) {
      for (int32_t x = 0; x <= box[0]; ++x) {
        if (!std::isnan(samples_[index({x, y, z})])) front.push_back({x, y, z});
      }
    }
  }
  if (front.empty()) samples_.assign(samples_.size(), positive ? 1.0f : -1.0f);
  while (!front.empty()) {
    const auto v = front.back();
    front.pop_back();
    for (int a = 0; a < 3; ++a) {
      for (int32_t side : {-1, 1}) {
        auto next = v;
        next[a] += side;
        if (next[a] < 0 || next[a] > box[a] || !std::isnan(samples_[index(next)])) continue;
        samples_[index(next)] = std::copysign(1.0f, samples_[index(v)]);
        front.push_back(next);
      }
    }
  }
}

}  // namespace isostar::bench
