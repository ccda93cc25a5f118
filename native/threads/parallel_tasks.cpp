#include "threads/parallel_tasks.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace isostar {
namespace {

unsigned wanted = 0;

unsigned threadCount() {
  return wanted != 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace

void useThreads(unsigned count) {
  wanted = count;
}

void runInParallel(size_t tasks, const std::function<void(size_t)>& work) {
  std::atomic<size_t> next{0};
  const auto worker = [&] {
    for (size_t task; (task = next++) < tasks;) work(task);
  };
  std::vector<std::thread> threads;
  for (size_t i = 1; i < std::min<size_t>(threadCount(), tasks); ++i) threads.emplace_back(worker);
  worker();
  for (std::thread& thread : threads) thread.join();
}

RunTasks parallelTasks() {
  return threadCount() > 1 ? RunTasks(runInParallel) : RunTasks();
}

}  // namespace isostar
