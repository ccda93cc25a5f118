#include "bench/synthetic_field.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>

#include "files/failure.h"

namespace isostar::bench {
namespace {

struct Recipe {
  std::array<int32_t, 3> size;
  std::function<double(double x, double y, double z)> value;  // positive inside
};

double sphere(double x, double y, double z) {
  return 37.3 - std::hypot(x - 47.6, y - 48.1, z - 47.9);
}

double torus(double x, double y, double z) {
  return 15.4 - std::hypot(std::hypot(x - 63.7, y - 64.2) - 41.8, z - 23.9);
}

double gyroid(double x, double y, double z) {
  constexpr double kWave = 0.23;
  x *= kWave, y *= kWave, z *= kWave;
  return std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
}

/// White noise, which no codec can predict (splitmix64 of the sample's index).
double noise(double x, double y, double z) {
  uint64_t n = static_cast<uint64_t>(x + 64 * (y + 64 * z)) * 0x9E3779B97F4A7C15;
  n = (n ^ n >> 30) * 0xBF58476D1CE4E5B9;
  n = (n ^ n >> 27) * 0x94D049BB133111EB;
  return static_cast<double>((n ^ n >> 31) >> 11) * 0x1p-53 - 0.5;
}

const std::map<std::string, Recipe>& recipes() {
  static const std::map<std::string, Recipe> kRecipes = {{"sphere", {{96, 96, 96}, sphere}},
                                                         {"torus", {{128, 128, 48}, torus}},
                                                         {"gyroid", {{96, 96, 96}, gyroid}},
                                                         {"noise", {{40, 40, 40}, noise}}};
  return kRecipes;
}

}  // namespace

SyntheticField syntheticField(const std::string& name) {
  const auto found = recipes().find(name);
  if (found == recipes().end())
    throw native::Failure(name, "is not one of sphere, torus, gyroid, noise");
  const Recipe& recipe = found->second;
  SyntheticField field;
  field.volume.size = recipe.size;
  for (int z = 0; z < recipe.size[2]; ++z) {
    for (int y = 0; y < recipe.size[1]; ++y) {
      for (int x = 0; x < recipe.size[0]; ++x)
        field.volume.samples.push_back(static_cast<float>(recipe.value(x, y, z)));
    }
  }
  return field;
}

}  // namespace isostar::bench
