#include "model/distance_field.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "measure/triangle_tree.h"
#include "model/inside_mask.h"
#include "threads/parallel_tasks.h"

namespace isostar::native {
namespace {

using Index = std::array<int32_t, 3>;

constexpr int kTask = 32;               // samples along a side of one thread's task
constexpr size_t kFewSamples = 8;       // a block of this size is not divided further
constexpr double kRounding = 1 + 1e-6;  // of the distance beyond which a block is skipped

/// The samples from `low` (inclusive) to `high` (exclusive).
struct Block {
  Index low, high;

  int side(int axis) const { return high[axis] - low[axis]; }
  size_t count() const { return size_t(side(0)) * size_t(side(1)) * size_t(side(2)); }
  int longestAxis() const {
    return side(0) >= side(1) && side(0) >= side(2) ? 0 : side(1) >= side(2) ? 1 : 2;
  }
  double radius() const { return 0.5 * std::hypot(side(0) - 1, side(1) - 1, side(2) - 1); }
};

/// Replaces the magnitudes of signed samples by distances, in a band around the surface.
class Band {
 public:
  Band(const measure::TriangleTree& tree, const SampleGrid& grid, std::vector<float>& samples)
      : tree_(tree), grid_(grid), samples_(samples) {}

  /// Distances change by at most one per grid step, so a block whose centre is far away is skipped.
  void fill(const Block& block, uint32_t& near) {
    if (block.count() <= kFewSamples) return fillEach(block, near);
    const double centre =
        distance(0.5 * (block.low[0] + block.high[0] - 1), 0.5 * (block.low[1] + block.high[1] - 1),
                 0.5 * (block.low[2] + block.high[2] - 1), near);
    if (centre > (block.radius() + kBand) * kRounding) return;
    const int axis = block.longestAxis();
    Block first = block, second = block;
    first.high[axis] = second.low[axis] = block.low[axis] + block.side(axis) / 2;
    fill(first, near);
    fill(second, near);
  }

 private:
  double distance(double i, double j, double k, uint32_t& near) const {
    return tree_.distance(grid_.at(i, j, k), near) / grid_.steps.x;
  }

  void fillEach(const Block& block, uint32_t& near) {
    for (int k = block.low[2]; k < block.high[2]; ++k) {
      for (int j = block.low[1]; j < block.high[1]; ++j) {
        float* row = &samples_[grid_.index(0, j, k)];
        for (int i = block.low[0]; i < block.high[0]; ++i)
          row[i] =
              std::copysign(std::min(kBand, static_cast<float>(distance(i, j, k, near))), row[i]);
      }
    }
  }

  const measure::TriangleTree& tree_;
  const SampleGrid& grid_;
  std::vector<float>& samples_;
};

std::vector<Block> tasksOf(const Index& size) {
  std::vector<Block> tasks;
  for (int k = 0; k < size[2]; k += kTask)
    for (int j = 0; j < size[1]; j += kTask)
      for (int i = 0; i < size[0]; i += kTask)
        tasks.push_back({Index{i, j, k},
                         {std::min(i + kTask, size[0]), std::min(j + kTask, size[1]),
                          std::min(k + kTask, size[2])}});
  return tasks;
}

std::vector<float> farSamples(const Mesh& mesh, const SampleGrid& grid) {
  const std::vector<uint8_t> inside = insideMask(mesh, grid);
  std::vector<float> samples(inside.size());
  std::transform(inside.begin(), inside.end(), samples.begin(),
                 [](uint8_t in) { return in ? kBand : -kBand; });
  return samples;
}

}  // namespace

std::vector<float> distanceField(const Mesh& mesh, const SampleGrid& grid,
                                 const std::function<void(double)>& progress) {
  std::vector<float> samples = farSamples(mesh, grid);
  const measure::TriangleTree tree(mesh);
  const std::vector<Block> tasks = tasksOf(grid.size);
  std::mutex progressMutex;
  size_t done = 0;
  runInParallel(tasks.size(), [&](size_t task) {
    uint32_t near = 0;
    Band(tree, grid, samples).fill(tasks[task], near);
    const std::lock_guard lock(progressMutex);
    progress(static_cast<double>(++done) / static_cast<double>(tasks.size()));
  });
  return samples;
}

}  // namespace isostar::native
