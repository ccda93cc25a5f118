// The exchange: the only interface between the traversal and the coder, and the only place where
// the source's values enter.
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

/// The encoder's side: answers with the source's values, which are then coded by a RangeEncoder or
/// a Meter. `actual`: the signs of the current level. `field`: scalars and decisions of the
/// encoder.
template <int D, class Coder, class Field>
class EncoderExchange {
 public:
  EncoderExchange(Coder& coder, const Signs<D>& actual, const Field& field)
      : coder_(coder), actual_(&actual), field_(field) {}

  Coder& coder() { return coder_; }
  [[nodiscard]] bool exhausted() const { return false; }
  [[nodiscard]] bool charge(uint64_t) const { return true; }
  void visitBrick() const {}
  void visit(uint64_t) const {}
  void hold(uint64_t) {}

  /// For a layer that spans several levels: by level, the signs, and the centres of the cells that
  /// are kept.
  void setLevels(std::span<const Signs<D>> actualByLevel, std::span<const Signs<D>> kept) {
    actualByLevel_ = actualByLevel;
    keptByLevel_ = kept;
  }
  /// Selects one of the levels that setLevels() gave.
  void enterLevel(int level) {
    if (actualByLevel_.empty()) return;
    actual_ = &actualByLevel_[static_cast<std::size_t>(level)];
    kept_ = &keptByLevel_[static_cast<std::size_t>(level)];
  }

  /// The signs of a row of a brick; bit x is vertex x.
  [[nodiscard]] uint32_t row(std::size_t brickIndex, std::size_t r) const {
    return actual_->brickAt(brickIndex).rows[r];
  }
  /// Does any vertex of a brick differ from a uniform brick, Signs::kNegative or kPositive?
  [[nodiscard]] bool varies(std::size_t brickIndex, uint32_t uniform) const {
    return actual_->slot(brickIndex) != uniform;
  }
  [[nodiscard]] bool positive(const Coordinates<D>& v) const { return actual_->at(v); }
  /// The first crossing simplex that has not been visited.
  [[nodiscard]] std::optional<Simplex<D>> nextSeed(const Lattice<D>& lattice,
                                                   const std::vector<uint8_t>& visited) const {
    for (std::size_t at = 0; at < visited.size(); ++at) {
      if (visited[at] != 0) continue;
      const auto simplex = Simplex<D>::at(at, lattice);
      int positives = 0;
      for (int i = 0; i <= D; ++i) positives += actual_->at(simplex.vertex(i));
      if (positives != 0 && positives != D + 1) return simplex;
    }
    return std::nullopt;
  }

  /// The smoothing filter that locates the level's surface best.
  void setFilter(SmoothingFilter filter) { filter_ = filter; }
  [[nodiscard]] SmoothingFilter filter() const { return filter_; }
  /// |scalar| in quantization steps, of vertex x in row r of a brick of the finest level.
  [[nodiscard]] uint32_t magnitude(std::size_t brickIndex, std::size_t r, int x) const {
    return field_.magnitude(brickIndex, r, x);
  }
  /// The value to code instead of the magnitude, in a pass that allows `allowed`, by edge as in
  /// FarEnds. `codedAt(axis, ahead)`: what Scalars store for the next vertex along an axis, or for
  /// the previous one. It is the magnitude itself if the field does not know distortions.
  template <class CodedAt, class Allowed>
  [[nodiscard]] RdoqTarget<D> rdoqTarget(std::size_t brickIndex, std::size_t r, int x,
                                         CodedAt codedAt, const Allowed& allowed) const {
    if constexpr (requires { field_.distortion(brickIndex, r, x, codedAt, allowed); })
      return {magnitude(brickIndex, r, x), field_.distortion(brickIndex, r, x, codedAt, allowed)};
    return {magnitude(brickIndex, r, x), {}};
  }
  /// The typical difference along a crossing edge of the brick: 4 log2 of quantization steps.
  [[nodiscard]] int gradient(std::size_t brickIndex) const { return field_.gradient(brickIndex); }
  /// How far a vertex of the finest level lies inside the domain, in the steps of
  /// Header::domainFineness(), rounded down.
  [[nodiscard]] int32_t domain(std::size_t brickIndex, std::size_t r, int x) const {
    return field_.domain(brickIndex, r, x);
  }
  /// By how many steps of the current pass a cube is to be displaced further. `block`: the one at
  /// the cube's lower corner.
  [[nodiscard]] int displacement(std::size_t brickIndex, std::size_t block) const {
    return field_.displacement(brickIndex, block);
  }
  /// Does the brick take part in a selective pass?
  [[nodiscard]] bool selected(std::size_t brickIndex) const { return field_.selected(brickIndex); }
  /// For one level of an adaptive mesh: the centres of the cells that are kept.
  void setKept(const Signs<D>& centres) { kept_ = &centres; }
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

/// The decoder's side: there is no source. All answers are constants, which the coder ignores, so
/// that the encoder's part of the traversal compiles to nothing.
template <int D>
class DecoderExchange {
 public:
  /// exhausted() becomes true after `slack` bytes beyond the end, when the current state needs more
  /// than `memory` bytes, or when work() exceeds `most`.
  DecoderExchange(RangeDecoder& coder, std::size_t slack, uint64_t memory,
                  uint64_t most = UINT64_MAX)
      : coder_(coder), slack_(slack), memory_(memory), mostWork_(most) {}

  RangeDecoder& coder() { return coder_; }
  /// Are the bytes of the layer or the memory used up? Anything decoded from here on is noise.
  [[nodiscard]] bool exhausted() const { return overBudget_ || coder_.overrun() > slack_; }
  /// Reports the memory that the current state uses, in bytes. False if the budget is exceeded or
  /// the bytes are used up: nothing more may be decoded then.
  [[nodiscard]] bool charge(uint64_t memory) {
    overBudget_ = overBudget_ || memory + held_ > memory_;
    visit(1);
    return !exhausted();
  }
  /// Reports that a brick's vertices are gone through, whether or not anything is decoded there.
  void visitBrick() { visit(kDecisionsPerBrick); }
  /// Reports work that takes about as long as so many decisions. Not inlined, to keep the
  /// WebAssembly decoder small.
  [[gnu::noinline]] void visit(uint64_t decisions) {
    walked_ += decisions;
    overBudget_ = overBudget_ || work() > mostWork_;
  }
  /// As Limits::decisions counts it.
  [[nodiscard]] uint64_t work() const { return coder_.decisions() + walked_; }
  /// Sets the bytes in use beside those that are reported to charge().
  void hold(uint64_t bytes) {
    held_ = bytes;
    overBudget_ = overBudget_ || held_ > memory_;
  }
  void enterLevel(int) {}
  [[nodiscard]] bool overBudget() const { return overBudget_; }

  [[nodiscard]] uint32_t row(std::size_t, std::size_t) const { return 0; }
  [[nodiscard]] uint32_t keptRow(std::size_t, std::size_t) const { return 0; }
  [[nodiscard]] bool varies(std::size_t, uint32_t) const { return false; }
  [[nodiscard]] bool positive(const Coordinates<D>&) const { return false; }
  [[nodiscard]] std::optional<Simplex<D>> nextSeed(const Lattice<D>&,
                                                   const std::vector<uint8_t>&) const {
    return std::nullopt;
  }
  [[nodiscard]] SmoothingFilter filter() const { return SmoothingFilter::Middle; }
  [[nodiscard]] uint32_t magnitude(std::size_t, std::size_t, int) const { return 0; }
  template <class CodedAt, class Allowed>
  [[nodiscard]] NoRdoqTarget rdoqTarget(std::size_t, std::size_t, int, CodedAt,
                                        const Allowed&) const {
    return {};
  }
  [[nodiscard]] int gradient(std::size_t) const { return 0; }
  [[nodiscard]] int32_t domain(std::size_t, std::size_t, int) const { return 0; }
  [[nodiscard]] int displacement(std::size_t, std::size_t) const { return 0; }
  [[nodiscard]] bool selected(std::size_t) const { return false; }

 private:
  /// One for each row: loading the windows takes as long.
  static constexpr uint64_t kDecisionsPerBrick = power(kBrickSide, D - 1);

  RangeDecoder& coder_;
  std::size_t slack_;
  uint64_t memory_, held_ = 0, mostWork_, walked_ = 0;
  bool overBudget_ = false;
};

}  // namespace isostar
