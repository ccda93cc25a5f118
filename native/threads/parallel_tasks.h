#pragma once

#include <cstddef>
#include <functional>

#include "isostar/isostar.h"

namespace isostar {

/// Sets how many threads runInParallel() uses; 0, the default, stands for one a processor. To be
/// called before any work begins.
void useThreads(unsigned count);

/// Calls work(task) for each task 0 … tasks - 1. The next idle thread takes the next task. A task
/// may call it again: its tasks are shared by the same threads. Throws the first exception of a
/// task, when all have returned.
void runInParallel(size_t tasks, const std::function<void(size_t)>& work);

/// The same as the codec takes it; empty if there is one thread.
RunTasks parallelTasks();

}  // namespace isostar
