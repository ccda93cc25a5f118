// The only place where truth meets the coder, and the only door that a traversal has.
#pragma once

#include <optional>
#include <span>

#include "coding/exchange/exchange_concepts.h"
#include "coding/exchange/rdoq_target.h"
#include "entropy/models.h"
#include "estimate/shape_estimate.h"
#include "grid/signs.h"
#include "grid/simplex.h"

namespace isostar {

/// The encoder's side: answers are the field's, told to a RangeEncoder or a Meter. Truth is asked
/// for the signs of the octave in work or for scalars.
template <int D, class Coder, class Field>
class EncoderExchange {
 public:
  EncoderExchange(Coder& coder, const Signs<D>& actual, const Field& field)
      : coder_(coder), actual_(&actual), field_(field) {}

  Coder& coder() { return coder_; }
  [[nodiscard]] bool exhausted() const { return false; }
  [[nodiscard]] bool charge(uint64_t) const { return true; }
  void hold(uint64_t) {}

  /// A layer of several octaves: their signs and the centres of their cells that stay whole, by
  /// octave.
  void follow(std::span<const Signs<D>> actualByLevel, std::span<const Signs<D>> kept) {
    actualByLevel_ = actualByLevel;
    keptByLevel_ = kept;
  }
  /// The octave in work, of those to follow.
  void enter(int level) {
    if (actualByLevel_.empty()) return;
    actual_ = &actualByLevel_[static_cast<std::size_t>(level)];
    kept_ = &keptByLevel_[static_cast<std::size_t>(level)];
  }

  /// The true signs of a row of a brick, bit x is vertex x.
  [[nodiscard]] uint32_t row(std::size_t brickIndex, std::size_t r) const {
    return actual_->brickAt(brickIndex).rows[r];
  }
  /// Is any vertex of a brick not of the sign given?
  [[nodiscard]] bool varies(std::size_t brickIndex, uint32_t uniform) const {
    return actual_->slot(brickIndex) != uniform;
  }
  [[nodiscard]] bool positive(const Coordinates<D>& v) const { return actual_->at(v); }
  /// The first crossing simplex that has not been visited.
  [[nodiscard]] std::optional<Simplex<D>> nextSeed(const Lattice<D>& lattice,
                                                   const std::vector<bool>& visited) const {
    for (std::size_t at = 0; at < visited.size(); ++at) {
      if (visited[at]) continue;
      const auto simplex = Simplex<D>::at(at, lattice);
      int positives = 0;
      for (int i = 0; i <= D; ++i) positives += actual_->at(simplex.vertex(i));
      if (positives != 0 && positives != D + 1) return simplex;
    }
    return std::nullopt;
  }

  /// The kernel that places the octave's surface best.
  void see(SmoothingFilter filter) { filter_ = filter; }
  [[nodiscard]] SmoothingFilter filter() const { return filter_; }
  /// |scalar - isovalue| in quanta, of vertex x in row r of a brick of the finest octave.
  [[nodiscard]] uint32_t magnitude(std::size_t brickIndex, std::size_t r, int x) const {
    return field_.magnitude(brickIndex, r, x);
  }
  /// What to tell of it in a pass that allows so much, by edge as in FarEnds. toldAt(axis, ahead):
  /// what Scalars know of the neighbour ahead on an axis, or before. The magnitude itself but for a
  /// field that knows of crossings.
  template <class CodedAt, class Allowed>
  [[nodiscard]] RdoqTarget<D> target(std::size_t brickIndex, std::size_t r, int x, CodedAt codedAt,
                                     const Allowed& allowed) const {
    if constexpr (requires { field_.distortion(brickIndex, r, x, codedAt, allowed); })
      return {magnitude(brickIndex, r, x), field_.distortion(brickIndex, r, x, codedAt, allowed)};
    return {magnitude(brickIndex, r, x), {}};
  }
  /// The typical difference along a crossing edge of the brick, 4 log2 of quanta.
  [[nodiscard]] int gradient(std::size_t brickIndex) const { return field_.gradient(brickIndex); }
  /// How far a vertex of the finest octave lies inside the domain, in quanta rounded down.
  [[nodiscard]] int32_t domain(std::size_t brickIndex, std::size_t r, int x) const {
    return field_.domain(brickIndex, r, x);
  }
  /// By how many steps of the pass in work a cube is to be displaced further; `block` is the one at
  /// its lower corner.
  [[nodiscard]] int displacement(std::size_t brickIndex, std::size_t block) const {
    return field_.displacement(brickIndex, block);
  }
  /// Does the brick take part in a selective pass?
  [[nodiscard]] bool selected(std::size_t brickIndex) const { return field_.selected(brickIndex); }
  /// Of an adaptive octave: the centres of cells that stay whole, as row() has signs.
  void keep(const Signs<D>& centres) { kept_ = &centres; }
  [[nodiscard]] uint32_t keptRow(std::size_t brickIndex, std::size_t r) const {
    return kept_->brickAt(brickIndex).rows[r];
  }

 private:
  Coder& coder_;
  const Signs<D>* actual_;
  const Field& field_;
  const Signs<D>* kept_ = nullptr;
  SmoothingFilter filter_ = SmoothingFilter::Middle;
  std::span<const Signs<D>> actualByLevel_, keptByLevel_;
};

/// The decoder's side: there is no field to ask, so that a peek at the truth does not compile into
/// anything.
template <int D>
class DecoderExchange {
 public:
  /// Stops after `slack` bytes past the end, or when the state in work takes more than `budget`
  /// bytes.
  DecoderExchange(RangeDecoder& coder, std::size_t slack, uint64_t budget)
      : coder_(coder), slack_(slack), budget_(budget) {}

  RangeDecoder& coder() { return coder_; }
  /// Are the bytes of the layer or the memory used up? What would be decoded from here on is noise.
  [[nodiscard]] bool exhausted() const { return overBudget_ || coder_.overrun() > slack_; }
  /// Accounts for the memory that the state in work uses. False once the budget has been exceeded,
  /// or the bytes are used up: then nothing more may be decoded.
  [[nodiscard]] bool charge(uint64_t memory) {
    overBudget_ = overBudget_ || memory + held_ > budget_;
    return !exhausted();
  }
  /// Bytes in use beside those that charge() is given.
  void hold(uint64_t bytes) {
    held_ = bytes;
    overBudget_ = overBudget_ || held_ > budget_;
  }
  void enter(int) {}
  [[nodiscard]] bool overBudget() const { return overBudget_; }

  [[nodiscard]] uint32_t row(std::size_t, std::size_t) const { return 0; }
  [[nodiscard]] uint32_t keptRow(std::size_t, std::size_t) const { return 0; }
  [[nodiscard]] bool varies(std::size_t, uint32_t) const { return false; }
  [[nodiscard]] bool positive(const Coordinates<D>&) const { return false; }
  [[nodiscard]] std::optional<Simplex<D>> nextSeed(const Lattice<D>&,
                                                   const std::vector<bool>&) const {
    return std::nullopt;
  }
  [[nodiscard]] SmoothingFilter filter() const { return SmoothingFilter::Middle; }
  [[nodiscard]] uint32_t magnitude(std::size_t, std::size_t, int) const { return 0; }
  template <class CodedAt, class Allowed>
  [[nodiscard]] NoRdoqTarget target(std::size_t, std::size_t, int, CodedAt, const Allowed&) const {
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
