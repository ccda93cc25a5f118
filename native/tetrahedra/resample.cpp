#include "tetrahedra/resample.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "files/failure.h"
#include "files/text.h"
#include "measure/in_parallel.h"
#include "tetrahedra/tetrahedron.h"

namespace isostar::native {
namespace {

using measure::Vector3;

constexpr double kStepsAnEdge = 2;
constexpr int kFewestSamples = 17, kLargestChosenGrid = 513;
constexpr double kReach = 2;  // grid steps beyond the domain: cells there share a sample with cells inside
constexpr double kMostSamples = 0x1p31;

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

/// What lies in a tetrahedron along a row of samples, told by the samples' index on it.
class Row {
 public:
  Row(const Tetrahedron& tetrahedron, const CubicGrid& grid, int j, int k)
      : tetrahedron_(tetrahedron), start_(tetrahedron.shares(grid.at(0, j, k))) {
    const Shares next = tetrahedron.shares(grid.at(1, j, k));
    for (size_t c = 0; c < 4; ++c) step_[c] = next.share[c] - start_.share[c];
  }

  /// Narrows [first, last] to where no share is negative.
  void narrow(double& first, double& last) const {
    for (size_t c = 0; c < 4; ++c) {
      const double share = start_.share[c] + kShareRounding;
      if (step_[c] > 0) first = std::max(first, -share / step_[c]);
      if (step_[c] < 0) last = std::min(last, -share / step_[c]);
      if (step_[c] == 0 && share < 0) last = first - 1;
    }
  }

  double value(int i) const {
    Shares shares = start_;
    for (size_t c = 0; c < 4; ++c) shares.share[c] += i * step_[c];
    return tetrahedron_.value(shares);
  }

 private:
  const Tetrahedron& tetrahedron_;
  Shares start_;
  std::array<double, 4> step_{};
};

/// Samples within the domain; others stay as they are.
void fillInside(const TetrahedralMesh& mesh, const CubicGrid& grid, std::vector<float>& samples) {
  for (const Corners4& corners : mesh.tetrahedra) {
    Vector3 low = mesh.points[corners[0]], high = low;
    for (uint32_t point : corners) {
      const Vector3& p = mesh.points[point];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const auto steps = [&](double x, double origin) { return (x - origin) / grid.step; };
    const auto first = [](double x) { return std::max(0, static_cast<int>(std::ceil(x - 1e-6))); };
    const auto last = [](double x, int size) { return std::min(size - 1, static_cast<int>(std::floor(x + 1e-6))); };
    const Tetrahedron tetrahedron(mesh, corners);
    for (int k = first(steps(low.z, grid.low.z)); k <= last(steps(high.z, grid.low.z), grid.size[2]); ++k) {
      for (int j = first(steps(low.y, grid.low.y)); j <= last(steps(high.y, grid.low.y), grid.size[1]); ++j) {
        const Row row(tetrahedron, grid, j, k);
        double from = steps(low.x, grid.low.x), to = steps(high.x, grid.low.x);
        row.narrow(from, to);
        float* out = &samples[(size_t(k) * size_t(grid.size[1]) + size_t(j)) * size_t(grid.size[0])];
        for (int i = first(from); i <= last(to, grid.size[0]); ++i) out[i] = static_cast<float>(row.value(i));
      }
    }
  }
}

/// A row's samples beyond the domain, and the distances of all to where it ends.
void finishRow(const TetrahedralField& field, const CubicGrid& grid, int j, int k, ResampledField& out,
               uint32_t& near) {
  const size_t row = (size_t(k) * size_t(grid.size[1]) + size_t(j)) * size_t(grid.size[0]);
  double known = 0;  // no less than this far from the boundary, in steps; it shrinks by one a step
  for (int i = 0; i < grid.size[0]; ++i, known -= 1) {
    float& sample = out.samples[row + size_t(i)];
    const bool inside = !std::isnan(sample);
    if (!inside) sample = static_cast<float>(field.beyond(grid.at(i, j, k), kReach * grid.step, near));
    if (known < kDomainBand) known = field.boundaryDistance(grid.at(i, j, k), near) / grid.step;
    out.domain[row + size_t(i)] =
        std::copysign(std::min(kDomainBand, static_cast<float>(known)), inside ? 1.0f : -1.0f);
  }
}

}  // namespace

CubicGrid gridOver(const TetrahedralField& field, double isovalue, std::optional<int> samples,
                   const std::string& path) {
  std::array<Vector3, 2> box = {field.mesh().points[0], field.mesh().points[0]};
  for (const Vector3& p : field.mesh().points) {
    box[0] = {std::min(box[0].x, p.x), std::min(box[0].y, p.y), std::min(box[0].z, p.z)};
    box[1] = {std::max(box[1].x, p.x), std::max(box[1].y, p.y), std::max(box[1].z, p.z)};
  }
  const Vector3 extent = box[1] - box[0];
  const double longest = std::max({extent.x, extent.y, extent.z});
  if (!samples) {
    const double edge = medianEdgeNear(field.mesh(), isovalue);
    const double wanted = edge > 0 ? kStepsAnEdge * longest / edge + 1 : kFewestSamples;
    samples = static_cast<int>(std::clamp<double>(std::ceil(wanted), kFewestSamples, kLargestChosenGrid));
  }
  CubicGrid grid{box[0], longest / (*samples - 1), {}};
  size_t axis = 0;
  for (const double each : {extent.x, extent.y, extent.z})
    grid.size[axis++] = std::max(2, static_cast<int32_t>(std::ceil(each / grid.step - 1e-6)) + 1);
  if (double(grid.size[0]) * grid.size[1] * grid.size[2] > kMostSamples)
    throw Failure(path, text("--grid %d makes %d x %d x %d samples; at most 2^31 can be encoded", *samples,
                             grid.size[0], grid.size[1], grid.size[2]));
  return grid;
}

ResampledField resample(const TetrahedralField& field, const CubicGrid& grid,
                        const std::function<void(double)>& progress) {
  ResampledField out{std::vector<float>(grid.count(), NAN), std::vector<float>(grid.count())};
  fillInside(field.mesh(), grid, out.samples);
  std::mutex telling;
  int done = 0;
  measure::inParallel(static_cast<size_t>(grid.size[2]), [&](size_t k) {
    uint32_t near = 0;
    for (int j = 0; j < grid.size[1]; ++j) finishRow(field, grid, j, static_cast<int>(k), out, near);
    const std::lock_guard lock(telling);
    progress(static_cast<double>(++done) / grid.size[2]);
  });
  return out;
}

}  // namespace isostar::native
