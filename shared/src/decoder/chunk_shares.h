// How the chunks of a stream are divided among decoders that decode it together.
#pragma once

#include <bit>

#include "container/index.h"
#include "util/cold_path.h"

namespace isostar {

/// Each chunk of a level belongs to one share, so that shares have about as many bytes of the
/// level, or of its first layer if that has pages. Layers of one chunk belong to all.
class ChunkShares {
 public:
  ISOSTAR_COLD ChunkShares(const Header& header, std::span<const LayerHead> heads,
                           const Share& share)
      : number_(share.number), of_(share.of) {
    if (share.of == 1) return;
    owners_.resize(static_cast<std::size_t>(header.finestLevel()) + 1);
    for (std::size_t level = 0; level < owners_.size(); ++level) {
      std::vector<uint64_t> bytes;
      for (const LayerHead& head : heads) {
        if (static_cast<std::size_t>(head.level) != level || head.sections.size() <= 1) continue;
        bytes.resize(head.sections.size());
        for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] += head.sections[i];
      }
      owners_[level] = divided(bytes, share.of);
    }
  }

  /// Divides a level whose first layer's pages have been read.
  ISOSTAR_COLD void divide(const LayerHead& first) {
    if (!areSeveral()) return;
    auto& owners = owners_[static_cast<std::size_t>(first.level)];
    if (owners.empty()) owners = divided(first.sections, of_);
  }

  /// Is the whole divided among several decoders?
  [[nodiscard]] bool areSeveral() const { return !owners_.empty(); }
  [[nodiscard]] bool owns(const LayerHead& head, std::size_t chunk) const {
    if (!areSeveral() || head.sections.size() == 1) return true;
    return owners_[static_cast<std::size_t>(head.level)][chunk] == number_;
  }

 private:
  /// By chunk, its share: long ones first, by the number of their bits, each to the share that has
  /// least.
  ISOSTAR_COLD static std::vector<int> divided(const std::vector<uint64_t>& bytes, int shares) {
    std::vector<uint64_t> sums(static_cast<std::size_t>(shares));
    std::vector<int> owners(bytes.size());
    for (int bits = 64; bits >= 0; --bits) {
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (static_cast<int>(std::bit_width(bytes[i])) != bits) continue;
        std::size_t least = 0;
        for (std::size_t share = 1; share < sums.size(); ++share)
          least = sums[share] < sums[least] ? share : least;
        sums[least] += bytes[i] + 1;
        owners[i] = static_cast<int>(least);
      }
    }
    return owners;
  }

  const int number_, of_;
  std::vector<std::vector<int>> owners_;  // by level, then by chunk; empty: one share
};

}  // namespace isostar
