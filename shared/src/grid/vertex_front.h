// The open vertices of a lattice, and those of them beside a vertex of the other sign: where a surface goes on.
#pragma once

#include <bit>
#include <optional>

#include "grid/window.h"

namespace isostar {

/// Signs that are being found out. Bricks wait in a queue; one is entered at a time, looked at with its surroundings and
/// left, upon which its neighbours wait again if it has changed.
template <int D>
class VertexFront {
 public:
  /// Open are the vertices that are not negative below and not positive above; null stands for all.
  [[gnu::noinline]] void begin(Signs<D>& signs, const Signs<D>* below, const Signs<D>* above) {
    signs_ = &signs;
    open_ = Signs<D>(signs.lattice());
    queued_.assign(places(), 0);
    queue_.assign(places(), 0);
    first_ = waiting_ = 0;
    const auto& lattice = signs.lattice();
    for (std::size_t place = 0; place < places(); ++place) {
      if ((below != nullptr && below->index(place) == Signs<D>::kNegative) || (above != nullptr && above->index(place) == Signs<D>::kPositive)) continue;
      const auto at = signs.table().brick(place);
      Brick<D> brick;
      for (std::size_t r = 0; r < brick.rows.size(); ++r) {
        brick.rows[r] = inside(lattice, at, r);
        if (below != nullptr) brick.rows[r] &= below->brickAt(place).rows[r];
        if (above != nullptr) brick.rows[r] &= static_cast<uint8_t>(~above->brickAt(place).rows[r]);
      }
      open_.put(place, brick);
    }
  }

  [[nodiscard]] std::size_t places() const { return signs_->table().total(); }
  [[nodiscard]] bool open(std::size_t place) const { return open_.index(place) != Signs<D>::kNegative; }
  [[nodiscard]] uint32_t openRow(std::size_t place, std::size_t r) const { return open_.brickAt(place).rows[r]; }
  /// Bytes in use, while one more brick is made, or while the signs become tidy.
  [[nodiscard]] uint64_t memory() const {
    return open_.memory() + places() * kBytesOfPlace + Signs<D>::memoryToFill(places(), signs_->brickCount());
  }
  /// Bytes that it takes at most to begin between signs with so many bricks.
  [[nodiscard]] static uint64_t memoryToBegin(const BrickTable<D>& table, uint64_t bricks) {
    for (int a = 0; a < D; ++a) bricks += table.total() / static_cast<std::size_t>(table.count(a));  // the lattice's end
    return table.total() * kBytesOfPlace + Signs<D>::memoryToFill(table.total(), bricks);
  }

  /// Closes a vertex of a brick with a sign; that of the entered one shows at once.
  [[gnu::noinline]] void close(std::size_t place, std::size_t r, int x, bool positive) {
    open_.writable(place).rows[r] &= static_cast<uint8_t>(~(1u << x));
    if ((signs_->brickAt(place).rows[r] >> x & 1) == (positive ? 1u : 0u)) return;
    signs_->writable(place).rows[r] ^= static_cast<uint8_t>(1u << x);
    if (place != entered_) return;
    window_.rows[Window<D>::kOwnRows[r]] ^= static_cast<uint16_t>(1u << (x + Window<D>::kHalo));
    changed_ = true;
  }

  void queueAll() {
    for (std::size_t place = 0; place < places(); ++place) queue(place);
  }
  /// The brick that has waited longest.
  [[nodiscard]] std::optional<std::size_t> next() {
    if (waiting_ == 0) return std::nullopt;
    const std::size_t place = queue_[first_];
    first_ = (first_ + 1) % queue_.size();
    --waiting_;
    queued_[place] = 0;
    return place;
  }

  void enter(std::size_t place) {
    entered_ = place;
    changed_ = false;
    window_.load(*signs_, signs_->table().brick(place));
  }
  void leave() {
    if (changed_) queueAround(entered_);
    changed_ = false;
    entered_ = SIZE_MAX;
  }
  /// What became of the signs: bricks of a single one are shared again.
  void end() {
    Signs<D> tidy(signs_->lattice());
    for (std::size_t place = 0; place < places(); ++place) tidy.put(place, signs_->brickAt(place));
    *signs_ = std::move(tidy);
    *this = VertexFront();
  }

  /// Of the entered brick.
  [[nodiscard]] const Window<D>& window() const { return window_; }
  [[nodiscard]] bool positive(std::size_t r, int x) const { return bit(Window<D>::kOwnRows[r], x); }
  [[nodiscard]] bool neighbour(std::size_t r, int x, int axis, int side) const {
    const int row = Window<D>::kOwnRows[r];
    return axis == 0 ? bit(row, x + side) : bit(row + side * Window<D>::rowStride(axis), x);
  }
  /// The open vertices of a row that have a neighbour of the other sign on an axis.
  [[nodiscard]] uint32_t beside(std::size_t place, std::size_t r) const {
    const uint32_t open = openRow(place, r);
    if (open == 0) return 0;
    const int row = Window<D>::kOwnRows[r];
    const uint32_t mine = window_.rows[row];
    uint32_t differ = (mine ^ mine >> 1) | (mine ^ mine << 1);
    for (int a = 1; a < D; ++a) differ |= (mine ^ window_.rows[row - Window<D>::rowStride(a)]) | (mine ^ window_.rows[row + Window<D>::rowStride(a)]);
    return differ >> Window<D>::kHalo & open;
  }

 private:
  static constexpr uint64_t kBytesOfPlace = 1 + sizeof(std::size_t);  // queued, and in the queue

  /// The vertices of a row of a brick that the lattice has.
  static uint8_t inside(const Lattice<D>& lattice, const Coordinates<D>& at, std::size_t r) {
    for (int a = 1; a < D; ++a, r /= kBrickSide) {
      if (at[a] * kBrickSide + static_cast<int32_t>(r % kBrickSide) > lattice.last[a]) return 0;
    }
    const int32_t count = std::min(lattice.last[0] + 1 - at[0] * kBrickSide, kBrickSide);
    return static_cast<uint8_t>((1u << count) - 1);
  }
  [[nodiscard]] bool bit(int row, int x) const { return (window_.rows[row] >> (x + Window<D>::kHalo) & 1) != 0; }

  void queue(std::size_t place) {
    if (queued_[place] != 0 || !open(place)) return;
    queued_[place] = 1;
    queue_[(first_ + waiting_++) % queue_.size()] = place;
  }
  [[gnu::noinline]] void queueAround(std::size_t place) {
    const auto& table = signs_->table();
    const auto at = table.brick(place);
    queue(place);
    for (int a = 0; a < D; ++a) {
      if (at[a] > 0) queue(place - table.stride(a));
      if (at[a] + 1 < table.count(a)) queue(place + table.stride(a));
    }
  }

  Signs<D>* signs_ = nullptr;
  Signs<D> open_;  // 1: open
  std::vector<uint8_t> queued_;
  std::vector<std::size_t> queue_;  // a ring: no brick waits twice
  std::size_t first_ = 0, waiting_ = 0;
  Window<D> window_;
  std::size_t entered_ = SIZE_MAX;
  bool changed_ = false;
};

}  // namespace isostar
