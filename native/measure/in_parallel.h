#pragma once

#include <cstddef>
#include <functional>

namespace isostar::measure {

/// Does tasks 0 … tasks - 1 on all processors; each is taken by the next thread that is free.
void inParallel(size_t tasks, const std::function<void(size_t)>& work);

}  // namespace isostar::measure
