// A level whose chunks are divided among several decoders.
#pragma once

#include <algorithm>
#include <optional>

#include "coding/chunk_results.h"
#include "coding/chunked_level.h"
#include "util/cold_path.h"

namespace isostar {

/// What decoders give each other: on each level the signs of all chunks, before the level is shown
/// and its geometry decoded; then the geometry beside own chunks, before a mesh is made.
template <int D>
class SharedLevel {
 public:
  using Level = ChunkedLevel<D>;

  /// A level whose own chunks are decoded. `expected`: by chunk, 1 for those of other shares.
  /// `isFirst`: chunks that no share decodes are shown by this one.
  ISOSTAR_COLD
  SharedLevel(typename Level::Joined joined, typename Level::Chunks chunks,
              std::vector<uint8_t> expected, SmoothingFilter filter, bool isFirst)
      : joined_(std::move(joined)),
        chunks_(std::move(chunks)),
        expected_(std::move(expected)),
        filter_(filter),
        own_(joined_->signs.table().total()) {
    for (std::size_t i = 0; i < chunks_.size(); ++i) {
      if (joined_->here[i] != 0)
        numbers_.push_back(i);
      else if (isFirst && expected_[i] == 0)
        unwanted_.push_back(i);
    }
  }

  /// Does the level lack signs?
  [[nodiscard]] bool isOpen() const { return joined_.has_value(); }
  /// By brick index of the level: 1 for bricks that this share shows, else 0.
  [[nodiscard]] const std::vector<uint8_t>& own() const { return own_; }
  /// The same with the bricks around them.
  [[nodiscard]] const std::vector<uint8_t>& beside() const { return beside_; }

  ISOSTAR_COLD void results(const CodecState<D>& whole, std::vector<std::byte>& out) const {
    ByteWriter writer(out);
    writer.u8(isOpen() ? kSigns : kGeometry);
    const ChunkGrid<D> grid(latticeOf(whole), whole.header.chunkSide);
    for (const std::size_t number : numbers_) {
      if (isOpen()) {
        writer.varint(number + 1);
        SignResults<D>::write(joined_->signs, grid.chunk(number), writer);
      } else {
        GeometryResults<D>::write(whole, whole.signs.table(), grid.chunk(number), writer);
      }
    }
    writer.varint(0);
  }
  /// False if the bytes are no results of another share.
  [[nodiscard]] ISOSTAR_COLD bool take(std::span<const std::byte> bytes, CodecState<D>& whole) {
    ByteReader in(bytes);
    if (in.u8() != (isOpen() ? kSigns : kGeometry)) return false;
    if (!isOpen()) return GeometryResults<D>::read(in, own_, whole);
    const ChunkGrid<D> grid(latticeOf(whole), whole.header.chunkSide);
    for (;;) {
      const uint64_t number = in.varint();
      if (in.overrun() || in.malformed() || number > expected_.size()) return false;
      if (number == 0) return true;
      uint8_t& expected = expected_[number - 1];
      if (expected == 0 || !SignResults<D>::read(in, grid.chunk(number - 1), joined_->signs))
        return false;
      expected = 0;
      joined_->has[number - 1] = 1;
    }
  }
  /// Ends the level. Corrupt if signs are missing.
  ISOSTAR_COLD Error close(CodecState<D>& whole, Level& level, const RunTasks& runTasks) {
    if (std::find(expected_.begin(), expected_.end(), 1) != expected_.end()) return Error::Corrupt;
    level.finishLevel(*std::move(joined_), std::move(chunks_), filter_, whole, runTasks);
    joined_.reset();
    const auto& table = whole.signs.table();
    const ChunkGrid<D> grid(whole.signs.lattice(), whole.header.chunkSide);
    for (const auto* numbers : {&numbers_, &unwanted_}) {
      for (const std::size_t number : *numbers)
        forEachBrickOf(grid.chunk(number), table, [&](std::size_t i) { own_[i] = 1; });
    }
    beside_ = own_;
    for (std::size_t i = 0; i < own_.size(); ++i) {
      if (own_[i] == 0) continue;
      for (const std::size_t other : table.around(table.brick(i))) {
        if (other != BrickTable<D>::kNowhere) beside_[other] = 1;
      }
    }
    return Error::None;
  }

  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = 2 * own_.size() + (joined_ ? joined_->signs.memory() : 0);
    for (const auto& chunk : chunks_) sum += chunk ? chunk->memory() : 0;
    return sum;
  }

 private:
  enum Kind : uint8_t { kSigns = 1, kGeometry = 2 };

  [[nodiscard]] const Lattice<D>& latticeOf(const CodecState<D>& whole) const {
    return isOpen() ? joined_->signs.lattice() : whole.signs.lattice();
  }

  std::optional<typename Level::Joined> joined_;
  typename Level::Chunks chunks_;
  std::vector<uint8_t> expected_;
  SmoothingFilter filter_;
  std::vector<uint8_t> own_, beside_;
  std::vector<std::size_t> numbers_, unwanted_;  // chunks that are own; that no share decodes
};

}  // namespace isostar
