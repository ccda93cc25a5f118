#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "files/failure.h"
#include "volume/volume_reader.h"

namespace isostar::native {

inline LoadedVolume readPath(const std::string& path) {
  return readVolume({.path = path});
}

/// What the reader complains of; empty where it does not.
inline std::string complaint(const VolumeRequest& request) {
  try {
    readVolume(request);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return {};
}
inline std::string complaint(const std::string& path) {
  return complaint(VolumeRequest{.path = path});
}

/// Sample (i,j,k) in the world.
inline std::array<double, 3> worldOf(const Placement& p, double i, double j, double k) {
  const std::array<double, 3> step = {i * p.spacing[0], j * p.spacing[1], k * p.spacing[2]};
  std::array<double, 3> world = p.origin;
  for (int row = 0; row < 3; ++row) {
    for (int axis = 0; axis < 3; ++axis) world[row] += p.direction[3 * row + axis] * step[axis];
  }
  return world;
}

inline void expectPoint(const std::array<double, 3>& found, double x, double y, double z) {
  EXPECT_NEAR(found[0], x, 1e-5);
  EXPECT_NEAR(found[1], y, 1e-5);
  EXPECT_NEAR(found[2], z, 1e-5);
}

template <class Float>
void expectCounting(const std::vector<Float>& samples) {
  for (size_t i = 0; i < samples.size(); ++i) ASSERT_EQ(samples[i], static_cast<Float>(i));
}

}  // namespace isostar::native
