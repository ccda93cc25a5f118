#pragma once

#include <cstddef>
#include <functional>

namespace isostar::measure {

/// Calls work(task) for each task 0 … tasks - 1 on all processors. The next idle thread takes the
/// next task.
void runInParallel(size_t tasks, const std::function<void(size_t)>& work);

}  // namespace isostar::measure
