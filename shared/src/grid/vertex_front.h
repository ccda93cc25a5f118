// The vertices of a lattice whose sign is still open, and those of them beside a vertex of the
// other sign: where a surface may continue.
#pragma once

#include <bit>
#include <optional>

#include "grid/window.h"

namespace isostar {

/// Signs that are being determined. Bricks wait in a queue. They are entered one at a time,
/// examined in a window and left; if a brick has changed, it and its neighbours are queued again.
template <int D>
class VertexFront {
 public:
  /// Opens the vertices that are not negative in `below` and not positive in `above`; null stands
  /// for all. `signs` are changed by close() and must outlive the front until end().
  [[gnu::noinline]] void begin(Signs<D>& signs, const Signs<D>* below, const Signs<D>* above) {
    signs_ = &signs;
    open_ = Signs<D>(signs.lattice());
    queued_.assign(tableSize(), 0);
    queue_.assign(tableSize(), 0);
    first_ = waiting_ = 0;
    const auto& lattice = signs.lattice();
    for (std::size_t brickIndex = 0; brickIndex < tableSize(); ++brickIndex) {
      if ((below != nullptr && below->slot(brickIndex) == Signs<D>::kNegative) ||
          (above != nullptr && above->slot(brickIndex) == Signs<D>::kPositive))
        continue;
      const auto at = signs.table().brick(brickIndex);
      Brick<D> brick;
      for (std::size_t r = 0; r < brick.rows.size(); ++r) {
        brick.rows[r] = inside(lattice, at, r);
        if (below != nullptr) brick.rows[r] &= below->brickAt(brickIndex).rows[r];
        if (above != nullptr)
          brick.rows[r] &= static_cast<uint8_t>(~above->brickAt(brickIndex).rows[r]);
      }
      open_.put(brickIndex, brick);
    }
  }

  /// How many bricks the lattice's table has.
  [[nodiscard]] std::size_t tableSize() const { return signs_->table().total(); }
  /// May the brick have open vertices?
  [[nodiscard]] bool open(std::size_t brickIndex) const {
    return open_.slot(brickIndex) != Signs<D>::kNegative;
  }
  /// The open vertices of row r of a brick, bit x for vertex x.
  [[nodiscard]] uint32_t openRow(std::size_t brickIndex, std::size_t r) const {
    return open_.brickAt(brickIndex).rows[r];
  }
  /// Bytes in use while one more brick is made, or while end() compacts the signs.
  [[nodiscard]] uint64_t memory() const {
    return open_.memory() + tableSize() * kBytesPerEntry +
           Signs<D>::memoryToFill(tableSize(), signs_->brickCount());
  }
  /// The most bytes that begin() takes. `bricks`: the most that `below` and `above` have together.
  [[nodiscard]] static uint64_t memoryToBegin(const BrickTable<D>& table, uint64_t bricks) {
    /// Bricks that the lattice's end cuts.
    for (int a = 0; a < D; ++a) bricks += table.total() / static_cast<std::size_t>(table.count(a));
    return table.total() * kBytesPerEntry + Signs<D>::memoryToFill(table.total(), bricks);
  }

  /// Decides the sign of an open vertex. In the window of the entered brick it shows at once.
  [[gnu::noinline]] void close(std::size_t brickIndex, std::size_t r, int x, bool positive) {
    open_.writable(brickIndex).rows[r] &= static_cast<uint8_t>(~(1u << x));
    if ((signs_->brickAt(brickIndex).rows[r] >> x & 1) == (positive ? 1u : 0u)) return;
    signs_->writable(brickIndex).rows[r] ^= static_cast<uint8_t>(1u << x);
    if (brickIndex != entered_) return;
    window_.rows[Window<D>::kOwnRows[r]] ^= static_cast<uint16_t>(1u << (x + Window<D>::kHalo));
    changed_ = true;
  }

  void queueAll() {
    for (std::size_t brickIndex = 0; brickIndex < tableSize(); ++brickIndex) queue(brickIndex);
  }
  /// Removes the brick that has waited longest from the queue; nothing if none waits.
  [[nodiscard]] std::optional<std::size_t> next() {
    if (waiting_ == 0) return std::nullopt;
    const std::size_t brickIndex = queue_[first_];
    first_ = (first_ + 1) % queue_.size();
    --waiting_;
    queued_[brickIndex] = 0;
    return brickIndex;
  }

  /// Loads the window of a brick; leave() must follow before the next one is entered.
  void enter(std::size_t brickIndex) {
    entered_ = brickIndex;
    changed_ = false;
    window_.load(*signs_, signs_->table().brick(brickIndex));
  }
  void leave() {
    if (changed_) queueAround(entered_);
    changed_ = false;
    entered_ = SIZE_MAX;
  }
  /// Finishes: bricks of a single sign share their storage again. The front is empty afterwards.
  void end() {
    Signs<D> tidy(signs_->lattice());
    for (std::size_t brickIndex = 0; brickIndex < tableSize(); ++brickIndex)
      tidy.put(brickIndex, signs_->brickAt(brickIndex));
    *signs_ = std::move(tidy);
    *this = VertexFront();
  }

  /// Of the entered brick, as are the signs below.
  [[nodiscard]] const Window<D>& window() const { return window_; }
  [[nodiscard]] bool positive(std::size_t r, int x) const { return bit(Window<D>::kOwnRows[r], x); }
  [[nodiscard]] bool neighbour(std::size_t r, int x, int axis, int side) const {
    const int row = Window<D>::kOwnRows[r];
    return axis == 0 ? bit(row, x + side) : bit(row + side * Window<D>::rowStride(axis), x);
  }
  /// The open vertices of row r of the entered brick that have a neighbour of the other sign along
  /// an axis, bit x for vertex x.
  [[nodiscard]] uint32_t beside(std::size_t brickIndex, std::size_t r) const {
    const uint32_t open = openRow(brickIndex, r);
    if (open == 0) return 0;
    const int row = Window<D>::kOwnRows[r];
    const uint32_t mine = window_.rows[row];
    uint32_t differ = (mine ^ mine >> 1) | (mine ^ mine << 1);
    for (int a = 1; a < D; ++a)
      differ |= (mine ^ window_.rows[row - Window<D>::rowStride(a)]) |
                (mine ^ window_.rows[row + Window<D>::rowStride(a)]);
    return differ >> Window<D>::kHalo & open;
  }

 private:
  static constexpr uint64_t kBytesPerEntry = 1 + sizeof(std::size_t);  // of queued_ and queue_

  /// The vertices of row r of a brick that lie in the lattice. `at`: the brick's coordinates.
  static uint8_t inside(const Lattice<D>& lattice, const Coordinates<D>& at, std::size_t r) {
    for (int a = 1; a < D; ++a, r /= kBrickSide) {
      if (at[a] * kBrickSide + static_cast<int32_t>(r % kBrickSide) > lattice.last[a]) return 0;
    }
    const int32_t count = std::min(lattice.last[0] + 1 - at[0] * kBrickSide, kBrickSide);
    return static_cast<uint8_t>((1u << count) - 1);
  }
  [[nodiscard]] bool bit(int row, int x) const {
    return (window_.rows[row] >> (x + Window<D>::kHalo) & 1) != 0;
  }

  void queue(std::size_t brickIndex) {
    if (queued_[brickIndex] != 0 || !open(brickIndex)) return;
    queued_[brickIndex] = 1;
    queue_[(first_ + waiting_++) % queue_.size()] = brickIndex;
  }
  [[gnu::noinline]] void queueAround(std::size_t brickIndex) {
    const auto& table = signs_->table();
    const auto at = table.brick(brickIndex);
    queue(brickIndex);
    for (int a = 0; a < D; ++a) {
      if (at[a] > 0) queue(brickIndex - table.stride(a));
      if (at[a] + 1 < table.count(a)) queue(brickIndex + table.stride(a));
    }
  }

  Signs<D>* signs_ = nullptr;
  Signs<D> open_;  // bit set: open
  std::vector<uint8_t> queued_;
  std::vector<std::size_t> queue_;  // a ring buffer; no brick is in it twice
  std::size_t first_ = 0, waiting_ = 0;
  Window<D> window_;
  std::size_t entered_ = SIZE_MAX;
  bool changed_ = false;
};

}  // namespace isostar
