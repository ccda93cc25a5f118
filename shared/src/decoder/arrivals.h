// The bytes of a stream that have arrived, as far as they are wanted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "isostar/isostar.h"
#include "util/cold_path.h"

namespace isostar {

/// Joins the wanted bytes of a stream in their order.
class Arrivals {
 public:
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  /// Where in the stream the last one of these bytes ends.
  [[nodiscard]] uint64_t end() const { return end_; }
  /// The first bytes at `from` or after that are wanted and have not arrived. At first all are
  /// wanted.
  [[nodiscard]] ByteRange wanted(uint64_t from = 0) const {
    // As much as headers and indices of most streams.
    constexpr uint64_t kAhead = 1 << 14;
    ByteRange next{position_, position_ + (isAll_ ? kAhead : 0)};
    if (!isAll_) {
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
    while (isAll_ || next_ < ranges_.size()) {
      if (offset > position_ || position_ - offset >= bytes.size()) return true;
      auto taken = bytes.subspan(static_cast<std::size_t>(position_ - offset));
      if (!isAll_) taken = taken.first(std::min<uint64_t>(taken.size(), wanted().end - position_));
      if (taken.size() > most - bytes_.size()) return false;
      bytes_.insert(bytes_.end(), taken.begin(), taken.end());
      end_ = position_ += taken.size();
      if (!isAll_ && position_ == ranges_[next_].end && ++next_ < ranges_.size())
        position_ = ranges_[next_].begin;
    }
    return true;
  }
  /// Wants these bytes only, in ascending order, beside the first `start` ones.
  ISOSTAR_COLD void want(std::vector<ByteRange> ranges, std::size_t start) {
    const std::vector<std::byte> tail(bytes_.begin() + static_cast<std::ptrdiff_t>(start),
                                      bytes_.end());
    bytes_.resize(start);
    ranges_ = std::move(ranges);
    isAll_ = false;
    end_ = start;
    position_ = ranges_.empty() ? start : ranges_.front().begin;
    accept(tail, start, UINT64_MAX);
  }

 private:
  std::vector<std::byte> bytes_;
  std::vector<ByteRange> ranges_;  // none is empty
  bool isAll_ = true;
  std::size_t next_ = 0;   // the range of the next wanted byte
  uint64_t position_ = 0;  // of the next wanted byte, or the end of the last one
  uint64_t end_ = 0;
};

}  // namespace isostar
