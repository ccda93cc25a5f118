// A number for each brick of a table, stored only where it varies.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "util/cold_path.h"

namespace isostar {

/// Maps brick indices to numbers. Most bricks of a box lie far from the surface and have one of few
/// common numbers: pages of consecutive indices exist only where others occur, so that memory grows
/// with the surface and only a pointer a page with the box.
template <class T, T... Common>
class BrickMap {
 public:
  static constexpr std::size_t kPage = 32;  // indices
  /// With what the heap adds.
  static constexpr uint64_t kBytesPerPage = kPage * sizeof(T) + 2 * sizeof(void*);

  BrickMap() = default;
  /// All have the first common number.
  ISOSTAR_COLD explicit BrickMap(std::size_t size)
      : size_(size), pages_((size + kPage - 1) / kPage, common(0)) {}
  ISOSTAR_COLD BrickMap(const BrickMap& other)
      : size_(other.size_), pages_(other.pages_), own_(other.own_) {
    for (const Page*& page : pages_) {
      if (!isCommon(page)) page = new Page(*page);
    }
  }
  ISOSTAR_COLD BrickMap(BrickMap&& other) noexcept { swap(other); }
  ISOSTAR_COLD BrickMap& operator=(BrickMap other) noexcept {
    swap(other);
    return *this;
  }
  ISOSTAR_COLD ~BrickMap() {
    for (const Page* page : pages_) release(page);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] T operator[](std::size_t brickIndex) const {
    return (*pages_[brickIndex / kPage])[brickIndex % kPage];
  }
  ISOSTAR_COLD void set(std::size_t brickIndex, T number) {
    const Page*& page = pages_[brickIndex / kPage];
    const std::size_t at = brickIndex % kPage;
    if ((*page)[at] == number) return;
    if (isCommon(page)) {
      page = new Page(*page);
      ++own_;
    }
    (*const_cast<Page*>(page))[at] = number;  // a page of its own
    // Numbers are mostly set one after the other.
    if (at == kPage - 1) merge(page);
  }
  /// Sets all to a common number.
  ISOSTAR_COLD void fill(T number) {
    for (const Page*& page : pages_) {
      release(page);
      page = commonOf(number);
    }
    own_ = 0;
  }

  /// Pages in memory, and pairs of neighbouring others that differ.
  [[nodiscard]] ISOSTAR_COLD std::size_t varied() const {
    std::size_t pairs = 0;
    for (std::size_t i = 1; i < pages_.size(); ++i)
      pairs += pages_[i] != pages_[i - 1] && isCommon(pages_[i]) && isCommon(pages_[i - 1]) ? 1 : 0;
    return own_ + pairs;
  }
  /// Bytes in use.
  [[nodiscard]] uint64_t memory() const {
    return pages_.capacity() * sizeof(Page*) + own_ * kBytesPerPage;
  }
  /// Bytes in use when one more number has been set.
  [[nodiscard]] uint64_t memoryToSet() const {
    return memory() + (own_ < pages_.size() ? kBytesPerPage : 0);
  }
  /// Bytes for so many pages at most.
  [[nodiscard]] static uint64_t memoryOf(uint64_t size, uint64_t pages) {
    const uint64_t all = (size + kPage - 1) / kPage;
    return all * sizeof(Page*) + std::min(all, pages) * kBytesPerPage;
  }

 private:
  using Page = std::array<T, kPage>;
  static constexpr std::array<T, sizeof...(Common)> kCommon{Common...};

  [[nodiscard]] static constexpr std::array<Page, sizeof...(Common)> commonPages() {
    std::array<Page, sizeof...(Common)> pages{};
    for (std::size_t i = 0; i < pages.size(); ++i) {
      for (T& number : pages[i]) number = kCommon[i];
    }
    return pages;
  }
  static constexpr std::array<Page, sizeof...(Common)> kCommonPages = commonPages();

  [[nodiscard]] static const Page* common(std::size_t i) { return &kCommonPages[i]; }
  /// Null if the number is none of the common ones.
  [[nodiscard]] static const Page* commonOf(T number) {
    for (std::size_t i = 0; i < kCommon.size(); ++i) {
      if (kCommon[i] == number) return common(i);
    }
    return nullptr;
  }
  [[nodiscard]] static bool isCommon(const Page* page) {
    bool is = false;
    for (const Page& one : kCommonPages) is = is || page == &one;
    return is;
  }
  static void release(const Page* page) {
    if (!isCommon(page)) delete page;
  }
  /// Drops a page of a single common number.
  void merge(const Page*& page) {
    const Page* one = commonOf(page->back());
    if (one == nullptr || *one != *page) return;
    release(page);
    page = one;
    --own_;
  }
  void swap(BrickMap& other) noexcept {
    std::swap(size_, other.size_);
    pages_.swap(other.pages_);
    std::swap(own_, other.own_);
  }

  std::size_t size_ = 0;
  std::vector<const Page*> pages_;
  std::size_t own_ = 0;
};

}  // namespace isostar
