#include "allocation.h"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

std::size_t held = 0, most = 0;

/// Null where there is no more.
void* counted(std::size_t size) noexcept {
  void* memory = std::malloc(size);
  held += malloc_usable_size(memory);
  most = std::max(most, held);
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  if (void* memory = counted(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(size);
}
void operator delete(void* memory) noexcept {
  if (memory != nullptr) held -= std::min(held, malloc_usable_size(memory));
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}

namespace isostar {

Allocation::Allocation() {
  held = most = 0;
}
std::size_t Allocation::peak() const {
  return most;
}

}  // namespace isostar
