#include "tetrahedra/grid_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "files/failure.h"
#include "files/text.h"
#include "tetrahedra/flat_boundary.h"
#include "tetrahedra/inner_boundary.h"

namespace isostar::native {
namespace {

using measure::Vector3;

constexpr double kStepsPerEdge = 2;
constexpr int kFewestSteps = 16, kMostChosenSteps = 512;
constexpr double kMostSamples = 0x1p31;  // of a grid, hence also along an axis
constexpr int kMostTimes = 2;            // times the wanted number of steps
constexpr double kMostUneven = 4;        // ratio of the steps on the axes of a thin mesh
constexpr double kPrice = 0.2;           // doubling the steps must gain a fifth of the boundary

/// The median length of crossing edges, weighted by length, because small tetrahedra cover less of
/// the surface each.
double medianCrossingEdge(const TetrahedralMesh& mesh, double isovalue) {
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

/// The share of the boundary that lies between planes of the grid, or that has another part on the
/// same plane.
double missed(const std::vector<FlatPart>& parts, double low, double step) {
  double sum = 0;
  for (size_t i = 0; i < parts.size(); ++i) {
    const double plane = (parts[i].coordinate - low) / step;
    if (std::abs(plane - std::round(plane)) > kOnBoundary) sum += parts[i].share;
    if (i > 0 && parts[i].coordinate - parts[i - 1].coordinate < (1 - kOnBoundary) * step)
      sum += std::min(parts[i].share, parts[i - 1].share);
  }
  return sum;
}

/// The wanted number of steps, or more if that puts flat parts of the boundary on planes of the
/// grid.
int stepsAlong(const std::vector<FlatPart>& parts, double low, double extent, int wanted) {
  double best = INFINITY;
  int chosen = wanted;
  for (int steps = wanted; steps <= kMostTimes * wanted; ++steps) {
    const double cost = missed(parts, low, extent / steps) + kPrice * (double(steps) / wanted - 1);
    if (cost < best) best = cost, chosen = steps;
  }
  return chosen;
}

struct Box {
  std::array<double, 3> low, extent;
  double longest() const { return std::max({extent[0], extent[1], extent[2]}); }
};

Box boxAround(const std::vector<Vector3>& points) {
  Vector3 low = points[0], high = points[0];
  for (const Vector3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vector3 extent = high - low;
  return {{low.x, low.y, low.z}, {extent.x, extent.y, extent.z}};
}

/// A grid over the box with the given step or smaller ones. `isFixed`: exactly this step on the
/// longest axis.
SampleGrid gridFor(const TetrahedralField& field, const Box& box, double step, bool isFixed,
                   const std::string& path) {
  const auto parts = flatParts(field.boundary().mesh);
  std::array<int, 3> count{};
  std::array<double, 3> length{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const double extent = box.extent[axis], wanted = std::max(1.0, std::ceil(extent / step - 1e-6));
    if (wanted > kMostSamples)
      throw Failure(path, "the grid would be too large; at most 2^31 samples can be encoded");
    const bool isLongest = extent == box.longest();
    count[axis] = static_cast<int>(wanted);
    if (!isFixed || !isLongest)
      count[axis] = stepsAlong(parts[axis], box.low[axis], extent, count[axis]);
    length[axis] = std::max(extent / count[axis], step / kMostUneven);
  }
  const SampleGrid grid{.low = {box.low[0], box.low[1], box.low[2]},
                        .steps = {length[0], length[1], length[2]},
                        .size = {count[0] + 1, count[1] + 1, count[2] + 1}};
  if (double(grid.size[0]) * grid.size[1] * grid.size[2] > kMostSamples)
    throw Failure(path,
                  text("a grid of %d x %d x %d samples is too large; at most 2^31 can be encoded",
                       grid.size[0], grid.size[1], grid.size[2]));
  return grid;
}

}  // namespace

double suitableStep(const TetrahedralField& field, double isovalue) {
  const double edge = medianCrossingEdge(field.mesh(), isovalue),
               longest = boxAround(field.mesh().points).longest();
  const double wanted = edge > 0 ? kStepsPerEdge * longest / edge : kFewestSteps;
  return longest / std::clamp<double>(std::ceil(wanted), kFewestSteps, kMostChosenSteps);
}

SampleGrid gridOfStep(const TetrahedralField& field, double step, const std::string& path) {
  return gridFor(field, boxAround(field.mesh().points), step, false, path);
}

SampleGrid chooseGrid(const TetrahedralField& field, double isovalue, std::optional<int> samples,
                      const std::string& path) {
  if (!samples) return gridOfStep(field, suitableStep(field, isovalue), path);
  const Box box = boxAround(field.mesh().points);
  return gridFor(field, box, box.longest() / (*samples - 1), true, path);
}

}  // namespace isostar::native
