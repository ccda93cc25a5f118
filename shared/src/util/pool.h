// Items that stay where they are as more come. Less code than a deque, which a page's decoder would
// have to load.
#pragma once

#include <memory>
#include <vector>

namespace isostar {

/// Each has memory of its own.
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
