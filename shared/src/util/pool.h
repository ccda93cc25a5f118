// A growing sequence whose items keep their addresses. It is less code than std::deque, which
// counts in the WebAssembly decoder.
#pragma once

#include <memory>
#include <vector>

namespace isostar {

/// Each item is an allocation of its own. A copy of a pool copies the items.
template <class T>
class Pool {
 public:
  Pool() = default;
  Pool(const Pool& other) {
    items_.reserve(other.size());
    for (const auto& item : other.items_) add(*item);
  }
  Pool(Pool&&) noexcept = default;
  Pool& operator=(Pool other) noexcept {
    items_.swap(other.items_);
    return *this;
  }

  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] const T& operator[](std::size_t i) const { return *items_[i]; }
  [[nodiscard]] T& operator[](std::size_t i) { return *items_[i]; }
  void add(const T& item) { items_.push_back(std::make_unique<T>(item)); }

 private:
  std::vector<std::unique_ptr<T>> items_;
};

}  // namespace isostar
