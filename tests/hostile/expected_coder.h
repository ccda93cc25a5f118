// Encodes a traversal without a source: most decisions are the ones that the models expect, which
// cost next to nothing.
#pragma once

#include <random>

#include "coding/exchange/exchange.h"

namespace isostar {

/// Encodes what the model expects instead of the actual decisions. `noisy`: how many of the first
/// decisions are random. `surprise`: the share of later ones that are not what the model expects.
class ExpectedCoder {
 public:
  ExpectedCoder(std::vector<std::byte>& out, uint64_t seed, uint64_t noisy, double surprise)
      : encoder_(out), random_(seed), noisy_(noisy), surprise_(surprise) {}

  bool bit(bool, uint32_t probability) {
    bool value = probability >= kProbabilityOne / 2;
    if (decisions_++ < noisy_)
      value = (random_() & 1) != 0;
    else if (surprise_ > 0)
      value ^= static_cast<double>(random_() >> 11) * 0x1p-53 < surprise_;
    return encoder_.bit(value, probability);
  }
  void finish() { encoder_.finish(); }
  [[nodiscard]] uint64_t decisions() const { return decisions_; }

 private:
  RangeEncoder encoder_;
  std::mt19937_64 random_;
  uint64_t decisions_ = 0, noisy_;
  double surprise_;
};

/// Answers like a decoder's side, and ends with the same limits.
template <int D>
class ExpectedExchange : public DecoderExchange<D> {
 public:
  ExpectedExchange(RangeDecoder& unused, ExpectedCoder& coder, const Limits& limits)
      : DecoderExchange<D>(unused, SIZE_MAX, limits.memory, limits.decisions),
        coder_(coder),
        most_(limits.decisions) {}

  ExpectedCoder& coder() { return coder_; }
  [[nodiscard]] bool exhausted() const { return this->overBudget() || spent() > most_; }
  [[nodiscard]] bool charge(uint64_t memory) {
    (void)DecoderExchange<D>::charge(memory);
    return !exhausted();
  }
  [[nodiscard]] uint64_t spent() const { return coder_.decisions() + this->work(); }

 private:
  ExpectedCoder& coder_;
  uint64_t most_;
};

}  // namespace isostar
