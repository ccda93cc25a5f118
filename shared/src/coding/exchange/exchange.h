// The only place where truth meets the coder, and the only door that a traversal has.
#pragma once

#include <optional>
#include <span>

#include "coding/exchange/rdoq_target.h"
#include "grid/signs.h"
#include "entropy/models.h"
#include "estimate/shape_estimate.h"
#include "grid/simplex.h"

namespace isostar {

/// The encoder's side: answers are the field's, told to a RangeEncoder or a Meter. Truth is asked for the signs of the
/// octave in work or for scalars.
template <int D, class Coder, class Field>
class TruthExchange {
 public:
  TruthExchange(Coder& coder, const Signs<D>& truth, const Field& field) : coder_(coder), truth_(&truth), field_(field) {}

  Coder& coder() { return coder_; }
  [[nodiscard]] bool spent(uint64_t = 0) const { return false; }
  void hold(uint64_t) {}

  /// A layer of several octaves: their signs and the centres of their cells that stay whole, by octave.
  void follow(std::span<const Signs<D>> truths, std::span<const Signs<D>> kept) {
    truths_ = truths;
    keptByOctave_ = kept;
  }
  /// The octave in work, of those to follow.
  void enter(int level) {
    if (truths_.empty()) return;
    truth_ = &truths_[static_cast<std::size_t>(level)];
    kept_ = &keptByOctave_[static_cast<std::size_t>(level)];
  }

  /// The true signs of a row of a brick, bit x is vertex x.
  [[nodiscard]] uint32_t row(std::size_t place, std::size_t r) const { return truth_->brickAt(place).rows[r]; }
  /// Is any vertex of a brick not of the sign given?
  [[nodiscard]] bool varies(std::size_t place, uint32_t uniform) const { return truth_->index(place) != uniform; }
  [[nodiscard]] bool positive(const Coordinates<D>& v) const { return truth_->at(v); }
  /// The first crossing simplex that has not been visited.
  [[nodiscard]] std::optional<Simplex<D>> nextSeed(const Lattice<D>& lattice, const std::vector<bool>& visited) const {
    for (std::size_t at = 0; at < visited.size(); ++at) {
      if (visited[at]) continue;
      const auto simplex = Simplex<D>::at(at, lattice);
      int positives = 0;
      for (int i = 0; i <= D; ++i) positives += truth_->at(simplex.vertex(i));
      if (positives != 0 && positives != D + 1) return simplex;
    }
    return std::nullopt;
  }

  /// The kernel that places the octave's surface best.
  void see(Kernel kernel) { kernel_ = kernel; }
  [[nodiscard]] Kernel kernel() const { return kernel_; }
  /// |scalar - isovalue| in quanta, of vertex x in row r of a brick of the finest octave.
  [[nodiscard]] uint32_t magnitude(std::size_t place, std::size_t r, int x) const { return field_.magnitude(place, r, x); }
  /// What to tell of it in a pass that allows so much, by edge as in FarEnds. toldAt(axis, ahead): what Scalars know of the neighbour
  /// ahead on an axis, or before. The magnitude itself but for a field that knows of crossings.
  template <class ToldAt, class Allowed>
  [[nodiscard]] Aim<D> aim(std::size_t place, std::size_t r, int x, ToldAt toldAt, const Allowed& allowed) const {
    if constexpr (requires { field_.errors(place, r, x, toldAt, allowed); }) return {magnitude(place, r, x), field_.errors(place, r, x, toldAt, allowed)};
    return {magnitude(place, r, x), {}};
  }
  /// The typical difference along a crossing edge of the brick, 4 log2 of quanta.
  [[nodiscard]] int gradient(std::size_t place) const { return field_.gradient(place); }
  /// How far a vertex of the finest octave lies inside the domain, in quanta rounded down.
  [[nodiscard]] int32_t domain(std::size_t place, std::size_t r, int x) const { return field_.domain(place, r, x); }
  /// By how many steps of the pass in work a cube is to be displaced further; `block` is the one at its lower corner.
  [[nodiscard]] int displacement(std::size_t place, std::size_t block) const { return field_.displacement(place, block); }
  /// Does the brick take part in a selective pass?
  [[nodiscard]] bool selected(std::size_t place) const { return field_.selected(place); }
  /// Of an adaptive octave: the centres of cells that stay whole, as row() has signs.
  void keep(const Signs<D>& centres) { kept_ = &centres; }
  [[nodiscard]] uint32_t keptRow(std::size_t place, std::size_t r) const { return kept_->brickAt(place).rows[r]; }

 private:
  Coder& coder_;
  const Signs<D>* truth_;
  const Field& field_;
  const Signs<D>* kept_ = nullptr;
  Kernel kernel_ = Kernel::Middle;
  std::span<const Signs<D>> truths_, keptByOctave_;
};

/// The decoder's side: there is no field to ask, so that a peek at the truth does not compile into anything.
template <int D>
class BlindExchange {
 public:
  /// Stops after `slack` bytes past the end, or when the state in work takes more than `budget` bytes.
  BlindExchange(RangeDecoder& coder, std::size_t slack, uint64_t budget) : coder_(coder), slack_(slack), budget_(budget) {}

  RangeDecoder& coder() { return coder_; }
  /// Are the bytes or the budget used up? What would be decoded from here on is noise.
  [[nodiscard]] bool spent(uint64_t memory = 0) {
    overBudget_ = overBudget_ || memory + held_ > budget_;
    return overBudget_ || coder_.overrun() > slack_;
  }
  /// Bytes that are in use beside those of the state in work.
  void hold(uint64_t bytes) { held_ = bytes; }
  void enter(int) {}
  [[nodiscard]] bool overBudget() const { return overBudget_; }

  [[nodiscard]] uint32_t row(std::size_t, std::size_t) const { return 0; }
  [[nodiscard]] uint32_t keptRow(std::size_t, std::size_t) const { return 0; }
  [[nodiscard]] bool varies(std::size_t, uint32_t) const { return false; }
  [[nodiscard]] bool positive(const Coordinates<D>&) const { return false; }
  [[nodiscard]] std::optional<Simplex<D>> nextSeed(const Lattice<D>&, const std::vector<bool>&) const { return std::nullopt; }
  [[nodiscard]] Kernel kernel() const { return Kernel::Middle; }
  [[nodiscard]] uint32_t magnitude(std::size_t, std::size_t, int) const { return 0; }
  template <class ToldAt, class Allowed>
  [[nodiscard]] NoAim aim(std::size_t, std::size_t, int, ToldAt, const Allowed&) const {
    return {};
  }
  [[nodiscard]] int gradient(std::size_t) const { return 0; }
  [[nodiscard]] int32_t domain(std::size_t, std::size_t, int) const { return 0; }
  [[nodiscard]] int displacement(std::size_t, std::size_t) const { return 0; }
  [[nodiscard]] bool selected(std::size_t) const { return false; }

 private:
  RangeDecoder& coder_;
  std::size_t slack_;
  uint64_t budget_, held_ = 0;
  bool overBudget_ = false;
};

}  // namespace isostar
