#include "tetrahedra/grid_over.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "files/failure.h"
#include "files/text.h"
#include "tetrahedra/boundary_within.h"
#include "tetrahedra/flat_boundary.h"

namespace isostar::native {
namespace {

using measure::Vector3;

constexpr double kStepsAnEdge = 2;
constexpr int kFewestSteps = 16, kMostChosenSteps = 512;
constexpr double kMostSamples = 0x1p31;
constexpr int kMostTimes = 2;  // as many steps as wanted
constexpr double kMostUneven = 4;
constexpr double kPrice = 0.2;  // twice the steps are worth a fifth of the boundary

/// The median length of crossing edges, each counted by its length: where tetrahedra are small, more of them are needed
/// for the same part of the surface.
double medianEdgeNear(const TetrahedralMesh& mesh, double isovalue) {
  std::vector<double> lengths;
  for (const Corners4& corners : mesh.tetrahedra) {
    for (size_t a = 0; a < 4; ++a) {
      for (size_t b = a + 1; b < 4; ++b) {
        if ((mesh.values[corners[a]] > isovalue) != (mesh.values[corners[b]] > isovalue))
          lengths.push_back(std::sqrt(squared(mesh.points[corners[a]] - mesh.points[corners[b]])));
      }
    }
  }
  std::sort(lengths.begin(), lengths.end());
  const double half = std::accumulate(lengths.begin(), lengths.end(), 0.0) / 2;
  double below = 0;
  for (const double length : lengths) {
    below += length;
    if (below >= half) return length;
  }
  return 0;
}

/// The part of the boundary that lies between planes of the grid or has another one on the same plane.
double missed(const std::vector<FlatPart>& parts, double low, double step) {
  double sum = 0;
  for (size_t i = 0; i < parts.size(); ++i) {
    const double plane = (parts[i].place - low) / step;
    if (std::abs(plane - std::round(plane)) > kOnBoundary) sum += parts[i].share;
    if (i > 0 && parts[i].place - parts[i - 1].place < (1 - kOnBoundary) * step)
      sum += std::min(parts[i].share, parts[i - 1].share);
  }
  return sum;
}

/// At least as many steps as wanted, and more where that brings flat parts of the boundary to planes of the grid.
int stepsAlong(const std::vector<FlatPart>& parts, double low, double extent, int wanted) {
  double best = INFINITY;
  int chosen = wanted;
  for (int steps = wanted; steps <= kMostTimes * wanted; ++steps) {
    const double cost = missed(parts, low, extent / steps) + kPrice * (double(steps) / wanted - 1);
    if (cost < best) best = cost, chosen = steps;
  }
  return chosen;
}

/// Steps along the longest axis that suit the tetrahedra.
int stepsFor(const TetrahedralMesh& mesh, double isovalue, double longest) {
  const double edge = medianEdgeNear(mesh, isovalue);
  const double wanted = edge > 0 ? kStepsAnEdge * longest / edge : kFewestSteps;
  return static_cast<int>(std::clamp<double>(std::ceil(wanted), kFewestSteps, kMostChosenSteps));
}

std::array<double, 3> coordinates(const Vector3& p) {
  return {p.x, p.y, p.z};
}

}  // namespace

SampleGrid gridOver(const TetrahedralField& field, double isovalue, std::optional<int> samples,
                    const std::string& path) {
  std::array<Vector3, 2> box = {field.mesh().points[0], field.mesh().points[0]};
  for (const Vector3& p : field.mesh().points) {
    box[0] = {std::min(box[0].x, p.x), std::min(box[0].y, p.y), std::min(box[0].z, p.z)};
    box[1] = {std::max(box[1].x, p.x), std::max(box[1].y, p.y), std::max(box[1].z, p.z)};
  }
  const auto low = coordinates(box[0]), extent = coordinates(box[1] - box[0]);
  const double longest = *std::max_element(extent.begin(), extent.end());
  const double step = longest / (samples ? *samples - 1 : stepsFor(field.mesh(), isovalue, longest));
  const auto parts = flatParts(field.boundary().mesh);
  std::array<int, 3> count{};
  std::array<double, 3> length{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const int wanted = std::max(1, static_cast<int>(std::ceil(extent[axis] / step - 1e-6)));
    const bool isFixed = samples && extent[axis] == longest;
    count[axis] = isFixed ? wanted : stepsAlong(parts[axis], low[axis], extent[axis], wanted);
    length[axis] = std::max(extent[axis] / count[axis], step / kMostUneven);
  }
  const SampleGrid grid{box[0], {length[0], length[1], length[2]}, {count[0] + 1, count[1] + 1, count[2] + 1}};
  if (double(grid.size[0]) * grid.size[1] * grid.size[2] > kMostSamples)
    throw Failure(path, text("a grid of %d x %d x %d samples is too large; at most 2^31 can be encoded", grid.size[0],
                             grid.size[1], grid.size[2]));
  return grid;
}

}  // namespace isostar::native
