// Pieces of work that do not depend on each other.
#pragma once

#include <cstddef>
#include <functional>

namespace isostar {

/// A page's decoder has no threads: it is smaller without them.
#ifdef __EMSCRIPTEN__
inline constexpr bool kRunsTasks = false;
#else
inline constexpr bool kRunsTasks = true;
#endif

/// Calls task(0) … task(count - 1) by the caller's means (RunTasks in isostar.h), or in order if
/// there are none.
template <class Task>
void runAll(const std::function<void(std::size_t, const std::function<void(std::size_t)>&)>& run,
            std::size_t count, Task task) {
  if constexpr (kRunsTasks) {
    if (run && count > 1) return run(count, task);
  }
  for (std::size_t i = 0; i < count; ++i) task(i);
}

}  // namespace isostar
