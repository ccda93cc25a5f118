// Pieces of work that do not depend on each other.
#pragma once

#include <cstddef>
#include <functional>

namespace isostar {

/// Calls task(0) … task(count - 1) by the caller's means (RunTasks in isostar.h), or in order if
/// there are none.
template <class Task>
void runAll(const std::function<void(std::size_t, const std::function<void(std::size_t)>&)>& run,
            std::size_t count, Task task) {
  if (run && count > 1) {
    run(count, task);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) task(i);
}

}  // namespace isostar
