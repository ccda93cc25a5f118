// Runs a traversal in memory: encoding, decoding, and encoding random answers.
#pragma once

#include <random>

#include "coding/exchange/exchange.h"

namespace isostar {

/// A field without scalars, for traversals that code signs only.
struct NoScalars {
  [[nodiscard]] uint32_t magnitude(std::size_t, std::size_t, int) const { return 0; }
  [[nodiscard]] int gradient(std::size_t) const { return 0; }
  [[nodiscard]] int32_t domain(std::size_t, std::size_t, int) const { return 0; }
  [[nodiscard]] int displacement(std::size_t, std::size_t) const { return 0; }
  [[nodiscard]] bool selected(std::size_t) const { return false; }
};

/// Runs `code` on the encoder's side and returns the bytes.
template <int D, class Field, class Code>
std::vector<std::byte> coded(const Signs<D>& actual, const Field& field, Code code) {
  std::vector<std::byte> bytes;
  RangeEncoder coder(bytes);
  EncoderExchange<D, RangeEncoder, Field> exchange(coder, actual, field);
  code(exchange);
  coder.finish();
  return bytes;
}

/// Runs `code` on the decoder's side. Decodes a copy of exactly the right size, so that the address
/// sanitizer sees an overrun. False if more was read than written.
template <int D, class Code>
[[nodiscard]] bool decoded(const std::vector<std::byte>& bytes, Code code) {
  const std::vector<std::byte> copy(bytes);
  RangeDecoder coder(copy);
  constexpr std::size_t kTrimmed = 8;
  DecoderExchange<D> exchange(coder, kTrimmed, SIZE_MAX);
  code(exchange);
  return !exchange.exhausted();
}

/// A coder that encodes random decisions instead of the actual ones, as an untrusted stream may
/// have them. `rate`: the probability of true; 1 stands for the probability that the model
/// predicts.
class RandomCoder {
 public:
  RandomCoder(std::vector<std::byte>& out, uint64_t seed, double rate)
      : encoder_(out), random_(seed), rate_(rate) {}
  bool bit(bool, uint32_t probability) {
    const auto limit = static_cast<uint64_t>(rate_ == 1 ? probability : rate_ * kProbabilityOne);
    return encoder_.bit(random_() % kProbabilityOne < limit, probability);
  }
  void finish() { encoder_.finish(); }

 private:
  RangeEncoder encoder_;
  std::mt19937_64 random_;
  double rate_;
};

/// Bytes of a traversal whose decisions are all random; there is no source behind them.
template <int D, class Code>
std::vector<std::byte> randomlyCoded(uint64_t seed, double rate, Code code) {
  std::vector<std::byte> bytes;
  RandomCoder coder(bytes, seed, rate);
  const Signs<D> nothing;
  const NoScalars none;
  struct NoSource : EncoderExchange<D, RandomCoder, NoScalars> {
    using EncoderExchange<D, RandomCoder, NoScalars>::EncoderExchange;
    [[nodiscard]] uint32_t row(std::size_t, std::size_t) const { return 0; }
    [[nodiscard]] uint32_t keptRow(std::size_t, std::size_t) const { return 0; }
    [[nodiscard]] bool varies(std::size_t, uint32_t) const { return false; }
    [[nodiscard]] bool positive(const Coordinates<D>&) const { return false; }
    [[nodiscard]] std::optional<Simplex<D>> nextSeed(const Lattice<D>&,
                                                     const std::vector<uint8_t>&) const {
      return std::nullopt;
    }
  };
  NoSource exchange(coder, nothing, none);
  code(exchange);
  coder.finish();
  return bytes;
}

}  // namespace isostar
