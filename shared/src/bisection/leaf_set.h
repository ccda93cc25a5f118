// A set of leaves of one mesh, as a hash table.
#pragma once

#include <vector>

#include "bisection/tagged_simplex.h"

namespace isostar {

/// Leaves are identified by the sum of their vertices: a multiple of their centroids, which differ
/// because the insides of leaves are disjoint.
template <int D>
class LeafSet {
 public:
  [[nodiscard]] bool has(const TaggedSimplex<D>& leaf) const {
    return !slots_.empty() && slots_[find(sum(leaf))] != kEmpty;
  }
  /// Adds a leaf. False if the set had it already.
  bool insert(const TaggedSimplex<D>& leaf) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    const Sum key = sum(leaf);
    const std::size_t at = find(key);
    if (slots_[at] != kEmpty) return false;
    slots_[at] = key;
    ++size_;
    return true;
  }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  using Sum = std::array<uint32_t, D>;
  /// No leaf has this sum: its vertices differ on every axis and are not negative.
  static constexpr Sum kEmpty{};

  static Sum sum(const TaggedSimplex<D>& leaf) {
    Sum total{};
    for (const auto& v : leaf.vertices) {
      for (int a = 0; a < D; ++a) total[a] += static_cast<uint32_t>(v[a]);
    }
    return total;
  }
  [[nodiscard]] std::size_t find(const Sum& key) const {
    uint64_t hash = 0;
    for (uint32_t x : key) hash = (hash ^ x) * 0x9E3779B97F4A7C15u, hash ^= hash >> 32;
    std::size_t at = static_cast<std::size_t>(hash) & (slots_.size() - 1);
    while (slots_[at] != kEmpty && slots_[at] != key) at = (at + 1) & (slots_.size() - 1);
    return at;
  }
  void grow() {
    const auto before = std::move(slots_);
    slots_.assign(before.empty() ? 64 : 2 * before.size(), kEmpty);
    for (const Sum& key : before) {
      if (key != kEmpty) slots_[find(key)] = key;
    }
  }

  std::vector<Sum> slots_;  // their number is a power of two; at least half are empty
  std::size_t size_ = 0;
};

}  // namespace isostar
