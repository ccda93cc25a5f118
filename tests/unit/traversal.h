// Both directions of a traversal, in memory; and a third, whose answers are thrown by dice.
#pragma once

#include <random>

#include "coding/exchange/exchange.h"

namespace isostar {

/// A field without scalars, for traversals that ask for signs only.
struct NoScalars {
  [[nodiscard]] uint32_t magnitude(std::size_t, std::size_t, int) const { return 0; }
  [[nodiscard]] int gradient(std::size_t) const { return 0; }
  [[nodiscard]] int32_t domain(std::size_t, std::size_t, int) const { return 0; }
  [[nodiscard]] int displacement(std::size_t, std::size_t) const { return 0; }
  [[nodiscard]] bool selected(std::size_t) const { return false; }
};

/// What `tell` says of the truth, in bytes.
template <int D, class Field, class Tell>
std::vector<std::byte> told(const Signs<D>& truth, const Field& field, Tell tell) {
  std::vector<std::byte> bytes;
  RangeEncoder coder(bytes);
  TruthExchange<D, RangeEncoder, Field> ask(coder, truth, field);
  tell(ask);
  coder.finish();
  return bytes;
}

/// Hears what was told, from a copy of the bytes in its very size. False where more was read than written.
template <int D, class Tell>
[[nodiscard]] bool heard(const std::vector<std::byte>& bytes, Tell tell) {
  const std::vector<std::byte> copy(bytes);
  RangeDecoder coder(copy);
  constexpr std::size_t kTrimmed = 8;
  BlindExchange<D> ask(coder, kTrimmed, SIZE_MAX);
  tell(ask);
  return !ask.spent();
}

/// An encoder that answers at random: whatever a valid stream may say. `rate` of 1: as the models expect; else so often
/// yes.
class Dice {
 public:
  Dice(std::vector<std::byte>& out, uint64_t seed, double rate) : encoder_(out), random_(seed), rate_(rate) {}
  bool bit(bool, uint32_t chance) {
    const auto limit = static_cast<uint64_t>(rate_ == 1 ? chance : rate_ * kChanceOne);
    return encoder_.bit(random_() % kChanceOne < limit, chance);
  }
  void finish() { encoder_.finish(); }

 private:
  RangeEncoder encoder_;
  std::mt19937_64 random_;
  double rate_;
};

/// Bytes of a traversal whose answers are thrown; no truth is behind them.
template <int D, class Tell>
std::vector<std::byte> thrown(uint64_t seed, double rate, Tell tell) {
  std::vector<std::byte> bytes;
  Dice dice(bytes, seed, rate);
  const Signs<D> nothing;
  const NoScalars none;
  struct Blind : TruthExchange<D, Dice, NoScalars> {
    using TruthExchange<D, Dice, NoScalars>::TruthExchange;
    [[nodiscard]] uint32_t row(std::size_t, std::size_t) const { return 0; }
    [[nodiscard]] uint32_t keptRow(std::size_t, std::size_t) const { return 0; }
    [[nodiscard]] bool varies(std::size_t, uint32_t) const { return false; }
    [[nodiscard]] bool positive(const Coordinates<D>&) const { return false; }
    [[nodiscard]] std::optional<Simplex<D>> nextSeed(const Lattice<D>&, const std::vector<bool>&) const {
      return std::nullopt;
    }
  };
  Blind ask(dice, nothing, none);
  tell(ask);
  dice.finish();
  return bytes;
}

}  // namespace isostar
