// A growing sequence whose items keep their addresses. It is less code than std::deque, which
// counts in the WebAssembly decoder.
#pragma once

#include <memory>
#include <vector>

namespace isostar {

/// Each item is an allocation of its own, or another pool's. A copy of a pool copies all items.
template <class T>
class Pool {
 public:
  Pool() = default;
  Pool(const Pool& other) {
    items_.reserve(other.size());
    for (const T* item : other.items_) add(*item);
  }
  Pool(Pool&&) noexcept = default;
  Pool& operator=(Pool other) noexcept {
    items_.swap(other.items_);
    own_.swap(other.own_);
    return *this;
  }

  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] const T& operator[](std::size_t i) const { return *items_[i]; }
  [[nodiscard]] T& operator[](std::size_t i) { return *items_[i]; }
  void add(const T& item) {
    own_.push_back(std::make_unique<T>(item));
    items_.push_back(own_.back().get());
  }
  /// Adds an item of another pool, which must outlive its use here.
  void refer(T& item) { items_.push_back(&item); }

 private:
  std::vector<T*> items_;
  std::vector<std::unique_ptr<T>> own_;
};

}  // namespace isostar
