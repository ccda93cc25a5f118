// Volumes with a known surface, of any size.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "isostar/isostar.h"

namespace isostar {

using Size = std::array<int32_t, 3>;
/// A scalar by sample coordinates; positive inside.
using Field = std::function<double(double x, double y, double z)>;

/// A volume that owns its samples.
struct SampledField {
  std::string name;
  Size size;
  std::vector<float> samples;
  Placement placement{};
  std::vector<float> domain{};

  [[nodiscard]] Volume volume() const { return {samples, size, placement, domain}; }
};

inline SampledField sampled(std::string name, const Size& size, const Field& field) {
  SampledField result{std::move(name), size, {}};
  for (int32_t z = 0; z < size[2]; ++z) {
    for (int32_t y = 0; y < size[1]; ++y) {
      for (int32_t x = 0; x < size[0]; ++x)
        result.samples.push_back(static_cast<float>(field(x, y, z)));
    }
  }
  return result;
}

/// The same field within a domain, which is given by the distance to its boundary.
inline SampledField within(const Field& domain, SampledField field) {
  field.domain = sampled("domain", field.size, domain).samples;
  return field;
}

/// Positive where n · p is above a limit; n is a unit vector.
inline Field halfSpace(const std::array<double, 3>& n, double limit) {
  return [=](double x, double y, double z) { return n[0] * x + n[1] * y + n[2] * z - limit; };
}

inline Field sphere(const Size& size, double share = 0.35) {
  const double radius = share * (std::min({size[0], size[1], size[2]}) - 1);
  return [=](double x, double y, double z) {
    return radius -
           std::hypot(x - 0.5 * (size[0] - 1), y - 0.5 * (size[1] - 1), z - 0.5 * (size[2] - 1)) +
           0.013;
  };
}

/// Around the z axis.
inline Field torus(const Size& size, double share = 0.27) {
  const double side = std::min(size[0], size[1]) - 1, large = share * side, small = 0.4 * large;
  return [=](double x, double y, double z) {
    const double ring = std::hypot(x - 0.5 * (size[0] - 1), y - 0.5 * (size[1] - 1)) - large;
    return small - std::hypot(ring, z - 0.5 * (size[2] - 1)) + 0.017;
  };
}

inline Field gyroid(double period = 11) {
  return [=](double x, double y, double z) {
    const double k = 2 * 3.14159265358979 / period;
    return std::sin(k * x) * std::cos(k * y) + std::sin(k * y) * std::cos(k * z) +
           std::sin(k * z) * std::cos(k * x) + 0.123;
  };
}

inline Field plane() {
  return [](double x, double y, double z) { return 0.41 * x + 0.3 * y - 0.7 * z + 0.9; };
}

/// Values in -1 … 1, the same on every machine.
inline Field noise(uint64_t seed = 1) {
  return [=](double x, double y, double z) {
    uint64_t h = seed;
    for (double c : {x, y, z}) {
      h = (h ^ static_cast<uint64_t>(c)) * 0xD6E8FEB86659FD93u + 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return static_cast<double>(h >> 11) * 0x1p-52 - 1;
  };
}

/// One field of each kind, all of one size.
inline std::vector<SampledField> fieldsOf(const Size& size) {
  const Field scan = gyroid(7), rough = noise(3);
  return {sampled("sphere", size, sphere(size)),
          sampled("torus", size, torus(size)),
          sampled("gyroid", size, gyroid()),
          sampled("plane", size, plane()),
          sampled("noise", size, noise()),
          sampled("whole numbers", size,
                  [=](double x, double y, double z) { return std::round(100 * scan(x, y, z)); }),
          sampled("bits", size,
                  [=](double x, double y, double z) { return scan(x, y, z) > 0 ? 1.0 : 0.0; }),
          sampled("rough", size, [=](double x, double y, double z) {
            return scan(x, y, z) + 0.4 * rough(x, y, z);
          })};
}

inline const std::vector<Size> kSizes{{2, 2, 2},    {3, 2, 4},   {5, 7, 3}, {9, 9, 9},
                                      {17, 16, 33}, {64, 9, 30}, {2, 40, 2}};

inline std::string described(const SampledField& field) {
  return field.name + " of " + std::to_string(field.size[0]) + "x" + std::to_string(field.size[1]) +
         "x" + std::to_string(field.size[2]);
}

}  // namespace isostar
