// Samples a function on a grid.
#include "isostar/isostar.h"

namespace isostar {

std::vector<float> sampled(const Field& field, const std::array<int32_t, 3>& size,
                           const Placement& placement) {
  std::vector<float> samples;
  for (const int32_t n : size) {
    if (n <= 0) return samples;
  }
  samples.reserve(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                  static_cast<std::size_t>(size[2]));
  const auto& [origin, spacing, d] = placement;
  for (int32_t k = 0; k < size[2]; ++k) {
    for (int32_t j = 0; j < size[1]; ++j) {
      for (int32_t i = 0; i < size[0]; ++i) {
        const double x = i * spacing[0], y = j * spacing[1], z = k * spacing[2];
        samples.push_back(static_cast<float>(field(origin[0] + d[0] * x + d[1] * y + d[2] * z,
                                                   origin[1] + d[3] * x + d[4] * y + d[5] * z,
                                                   origin[2] + d[6] * x + d[7] * y + d[8] * z)));
      }
    }
  }
  return samples;
}

}  // namespace isostar
