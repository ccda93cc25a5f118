#include "tetrahedra/resampled_field.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "tetrahedra/inner_boundary.h"
#include "tetrahedra/tetrahedron.h"
#include "threads/parallel_tasks.h"

namespace isostar::native {
namespace {

using measure::Vector3;

/// In grid steps beyond the domain: cells there share samples with cells inside.
constexpr double kReach = 2;

/// Guesses for the next sample, as TriangleTree::distance() takes them.
struct Nearest {
  uint32_t face = 0, end = 0;
};

/// The intersection of a tetrahedron with a row of samples, parametrized by the index along the
/// row.
class Row {
 public:
  Row(const Tetrahedron& tetrahedron, const SampleGrid& grid, int j, int k)
      : tetrahedron_(tetrahedron), start_(tetrahedron.shares(grid.at(0, j, k))) {
    const Shares next = tetrahedron.shares(grid.at(1, j, k));
    for (size_t c = 0; c < 4; ++c) step_[c] = next.share[c] - start_.share[c];
  }

  /// Narrows [first, last] to the part inside the tetrahedron, where no share is negative.
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

/// Fills in the samples inside the domain; the others are unchanged.
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
        float* out = &samples[grid.index(0, j, k)];
        for (int i = first(begin); i <= last(end, grid.size[0]); ++i)
          out[i] = static_cast<float>(row.value(i));
      }
    }
  }
}

/// Fills in a row's samples beyond the domain, and the distances of all samples to the inner
/// boundary.
void finishRow(const TetrahedralField& field, const measure::TriangleTree& ends,
               const SampleGrid& grid, int j, int k, ResampledField& out, Nearest& near) {
  const size_t row = grid.index(0, j, k);
  const double unit = grid.smallestStep();
  const double reach = kReach * std::max({grid.steps.x, grid.steps.y, grid.steps.z});
  double known = 0;  // a lower bound of the distance to the boundary, in smallest steps
  for (int i = 0; i < grid.size[0]; ++i, known -= grid.steps.x / unit) {
    const Vector3 position = grid.at(i, j, k);
    float& sample = out.samples[row + size_t(i)];
    bool within = !std::isnan(sample);
    if (!within) {
      sample = static_cast<float>(field.beyond(position, reach, near.face));
      within = field.boundaryDistance(position, near.face) <= kOnBoundary * unit;
    }
    if (out.domain.empty()) continue;
    if (known < kDomainBand) known = ends.distance(position, near.end) / unit;
    const float distance = std::min(kDomainBand, static_cast<float>(known));
    out.domain[row + size_t(i)] = within ? distance : -distance;
  }
}

}  // namespace

ResampledField resample(const TetrahedralField& field, const SampleGrid& grid,
                        const std::function<void(double)>& progress) {
  const Mesh boundary = innerBoundary(grid, field.boundary().mesh);
  const measure::TriangleTree ends(boundary);
  ResampledField out;
  out.samples.assign(grid.count(), NAN);
  if (!boundary.indices.empty()) out.domain.resize(grid.count());
  fillInside(field.mesh(), grid, out.samples);
  std::mutex progressMutex;
  int done = 0;
  runInParallel(static_cast<size_t>(grid.size[2]), [&](size_t k) {
    Nearest near;
    for (int j = 0; j < grid.size[1]; ++j)
      finishRow(field, ends, grid, j, static_cast<int>(k), out, near);
    const std::lock_guard lock(progressMutex);
    progress(static_cast<double>(++done) / grid.size[2]);
  });
  if (!out.domain.empty()) openThinGaps(field, grid, out.domain);
  return out;
}

}  // namespace isostar::native
