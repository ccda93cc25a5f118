// The bytes of a stream that have arrived, as far as they are wanted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "container/bytes.h"
#include "isostar/isostar.h"
#include "util/cold_path.h"

namespace isostar {

/// Joins the wanted bytes of a stream in their order.
class Arrivals {
 public:
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  /// Where in the stream the last one of these bytes ends.
  [[nodiscard]] uint64_t end() const { return end_; }
  /// The first bytes at `from` or after that are wanted and have not arrived. While it is not known
  /// what is wanted, all bytes are kept.
  [[nodiscard]] ByteRange wanted(uint64_t from = 0) const {
    // As much as headers and indices of most streams.
    constexpr uint64_t kAhead = 1 << 14;
    ByteRange next{position_, position_};
    if (next_ == ranges_.size()) {
      next.end += isOpen_ ? kAhead : 0;
    } else {
      const auto found = std::upper_bound(
          ranges_.begin() + static_cast<std::ptrdiff_t>(next_), ranges_.end(), from,
          [](uint64_t at, const ByteRange& range) { return at < range.end; });
      if (found != ranges_.end()) next = {std::max(position_, found->begin), found->end};
    }
    next.begin = std::min(std::max(next.begin, from), next.end);
    return next;
  }

  /// Takes what is wanted of the bytes that begin at `offset`. False if that would be more than
  /// `most` bytes.
  ISOSTAR_COLD bool accept(std::span<const std::byte> bytes, uint64_t offset, uint64_t most) {
    while (isOpen_ || next_ < ranges_.size()) {
      if (offset > position_ || position_ - offset >= bytes.size()) return true;
      auto taken = bytes.subspan(static_cast<std::size_t>(position_ - offset));
      const bool isLimited = next_ < ranges_.size();
      if (isLimited)
        taken = taken.first(std::min<uint64_t>(taken.size(), ranges_[next_].end - position_));
      if (taken.size() > most - bytes_.size()) return false;
      append(bytes_, taken);
      end_ = position_ += taken.size();
      if (isLimited && position_ == ranges_[next_].end && ++next_ < ranges_.size())
        position_ = ranges_[next_].begin;
    }
    return true;
  }
  /// Wants these bytes behind the `first` first ones, in ascending order. Of the bytes kept behind
  /// these, which lie together, others are dropped. `isOpen`: more ranges may follow the last one.
  /// All ranges wanted before have arrived.
  ISOSTAR_COLD void want(std::vector<ByteRange> ranges, bool isOpen, std::size_t first) {
    const std::vector<std::byte> tail(bytes_.begin() + static_cast<std::ptrdiff_t>(first),
                                      bytes_.end());
    bytes_.resize(first);
    ranges_ = std::move(ranges);
    next_ = 0;
    isOpen_ = isOpen;
    const uint64_t start = end_ - tail.size();
    end_ = position_ = start;
    if (!ranges_.empty()) position_ = ranges_.front().begin;
    accept(tail, start, UINT64_MAX);
  }

 private:
  std::vector<std::byte> bytes_;
  std::vector<ByteRange> ranges_;  // of which it is known that they are wanted; none is empty
  bool isOpen_ = true;             // may more be wanted behind the last range?
  std::size_t next_ = 0;           // the range of the next wanted byte
  uint64_t position_ = 0;          // of the next wanted byte, or the end of the last one
  uint64_t end_ = 0;
};

}  // namespace isostar
