#include "tetrahedra/resample.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "measure/in_parallel.h"
#include "tetrahedra/boundary_within.h"
#include "tetrahedra/tetrahedron.h"

namespace isostar::native {
namespace {

using measure::Vector3;

constexpr double kReach =
    2;  // grid steps beyond the domain: cells there share a sample with cells inside

/// Guesses for the next sample: see TriangleTree.
struct Nearest {
  uint32_t face = 0, end = 0;
};

/// What lies in a tetrahedron along a row of samples, told by the samples' index on it.
class Row {
 public:
  Row(const Tetrahedron& tetrahedron, const SampleGrid& grid, int j, int k)
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
void fillInside(const TetrahedralMesh& mesh, const SampleGrid& grid, std::vector<float>& samples) {
  for (const Corners4& corners : mesh.tetrahedra) {
    Vector3 low = mesh.points[corners[0]], high = low;
    for (uint32_t point : corners) {
      const Vector3& p = mesh.points[point];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vector3 from = grid.inSteps(low), to = grid.inSteps(high);
    const auto first = [](double x) { return std::max(0, static_cast<int>(std::ceil(x - 1e-6))); };
    const auto last = [](double x, int size) {
      return std::min(size - 1, static_cast<int>(std::floor(x + 1e-6)));
    };
    const Tetrahedron tetrahedron(mesh, corners);
    for (int k = first(from.z); k <= last(to.z, grid.size[2]); ++k) {
      for (int j = first(from.y); j <= last(to.y, grid.size[1]); ++j) {
        const Row row(tetrahedron, grid, j, k);
        double begin = from.x, end = to.x;
        row.narrow(begin, end);
        float* out =
            &samples[(size_t(k) * size_t(grid.size[1]) + size_t(j)) * size_t(grid.size[0])];
        for (int i = first(begin); i <= last(end, grid.size[0]); ++i)
          out[i] = static_cast<float>(row.value(i));
      }
    }
  }
}

/// A row's samples beyond the domain, and the distances of all to where it ends within the grid.
void finishRow(const TetrahedralField& field, const measure::TriangleTree& ends,
               const SampleGrid& grid, int j, int k, ResampledField& out, Nearest& near) {
  const size_t row = (size_t(k) * size_t(grid.size[1]) + size_t(j)) * size_t(grid.size[0]);
  const double unit = grid.smallestStep();
  const double reach = kReach * std::max({grid.steps.x, grid.steps.y, grid.steps.z});
  double known =
      0;  // no less than this far from the boundary, in steps; it shrinks from sample to sample
  for (int i = 0; i < grid.size[0]; ++i, known -= grid.steps.x / unit) {
    const Vector3 place = grid.at(i, j, k);
    float& sample = out.samples[row + size_t(i)];
    bool within = !std::isnan(sample);
    if (!within) {
      sample = static_cast<float>(field.beyond(place, reach, near.face));
      within = field.boundaryDistance(place, near.face) <= kOnBoundary * unit;
    }
    if (out.domain.empty()) continue;
    if (known < kDomainBand) known = ends.distance(place, near.end) / unit;
    const float distance = std::min(kDomainBand, static_cast<float>(known));
    out.domain[row + size_t(i)] = within ? distance : -distance;
  }
}

}  // namespace

ResampledField resample(const TetrahedralField& field, const SampleGrid& grid,
                        const std::function<void(double)>& progress) {
  const Mesh boundary = boundaryWithin(grid, field.boundary().mesh);
  const measure::TriangleTree ends(boundary);
  ResampledField out{std::vector<float>(grid.count(), NAN), {}};
  if (!boundary.indices.empty()) out.domain.resize(grid.count());
  fillInside(field.mesh(), grid, out.samples);
  std::mutex telling;
  int done = 0;
  measure::inParallel(static_cast<size_t>(grid.size[2]), [&](size_t k) {
    Nearest near;
    for (int j = 0; j < grid.size[1]; ++j)
      finishRow(field, ends, grid, j, static_cast<int>(k), out, near);
    const std::lock_guard lock(telling);
    progress(static_cast<double>(++done) / grid.size[2]);
  });
  if (!out.domain.empty()) seeThinAir(field, grid, out.domain);
  return out;
}

}  // namespace isostar::native
