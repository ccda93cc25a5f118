#include "threads/parallel_tasks.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <vector>

namespace isostar {
namespace {

class ParallelTasks : public testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override { useThreads(GetParam()); }
  void TearDown() override { useThreads(0); }
};

TEST_P(ParallelTasks, runEachOnce) {
  for (const std::size_t tasks : {0, 1, 2, 3, 100}) {
    std::vector<int> runs(tasks);
    runInParallel(tasks, [&](std::size_t task) { ++runs[task]; });
    EXPECT_EQ(runs, std::vector<int>(tasks, 1));
  }
}

TEST_P(ParallelTasks, haveReturnedWhenTheirCallReturns) {
  std::array<std::array<int, 50>, 20> runs{};
  std::array<int, 20> sums{};
  runInParallel(runs.size(), [&](std::size_t outer) {
    runInParallel(runs[outer].size(), [&](std::size_t inner) { runs[outer][inner] = 1; });
    for (const int run : runs[outer]) sums[outer] += run;
  });
  for (const int sum : sums) EXPECT_EQ(sum, 50);
}

TEST_P(ParallelTasks, useNoMoreThreadsThanWanted) {
  std::atomic<unsigned> running{0}, most{0};
  runInParallel(8, [&](std::size_t) {
    runInParallel(8, [&](std::size_t) {
      const unsigned now = ++running;
      for (unsigned seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
      }
      --running;
    });
  });
  EXPECT_LE(most, GetParam());
}

TEST_P(ParallelTasks, passOnWhatATaskThrows) {
  std::atomic<int> returned{0};
  const auto work = [&](std::size_t task) {
    if (task == 3) throw std::runtime_error("three");
    ++returned;
  };
  EXPECT_THROW(runInParallel(10, work), std::runtime_error);
  EXPECT_EQ(returned, 9);
  runInParallel(3, work);
  EXPECT_EQ(returned, 12);
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelTasks, testing::Values(1, 2, 3, 7));

}  // namespace
}  // namespace isostar
