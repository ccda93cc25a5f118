#include "entropy/range_coder.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

namespace isostar {
namespace {

struct Decision {
  bool actual;
  uint32_t probability;
};
using Decisions = std::vector<Decision>;

std::vector<std::byte> encoded(const Decisions& decisions) {
  std::vector<std::byte> out;
  RangeEncoder encoder(out);
  for (const auto& d : decisions) EXPECT_EQ(encoder.bit(d.actual, d.probability), d.actual);
  encoder.finish();
  return out;
}

double metered(const Decisions& decisions) {
  Meter meter;
  for (const auto& d : decisions) meter.bit(d.actual, d.probability);
  return meter.bits();
}

/// Decodes from a buffer of exactly the encoded length, so that the address sanitizer sees an
/// overrun.
void expectRoundTrip(const Decisions& decisions) {
  const auto bytes = encoded(decisions);
  RangeDecoder decoder(bytes);
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    ASSERT_EQ(decoder.bit(!decisions[i].actual, decisions[i].probability), decisions[i].actual)
        << "decision " << i;
  }
  EXPECT_LE(decoder.overrun(), 8u);
  EXPECT_LE(static_cast<double>(bytes.size()),
            metered(decisions) / 8 + 4 + static_cast<double>(decisions.size()) * 2e-5);
}

/// Random decisions. `probability` draws the probability of each from a random generator.
template <class DrawProbability>
Decisions drawn(std::size_t count, uint64_t seed, DrawProbability probability) {
  std::mt19937_64 random(seed);
  Decisions decisions;
  for (std::size_t i = 0; i < count; ++i) {
    const auto c = static_cast<uint32_t>(probability(random));
    decisions.push_back({random() % kProbabilityOne < c, c});
  }
  return decisions;
}

TEST(RangeCoder, roundTripsAnyProbabilities) {
  const uint32_t span = kProbabilityOne - 2 * kLeastProbability + 1;
  for (uint64_t seed = 0; seed < 20; ++seed)
    expectRoundTrip(drawn(5000, seed, [&](auto& r) { return kLeastProbability + r() % span; }));
}

TEST(RangeCoder, roundTripsEachFixedProbability) {
  for (uint32_t probability :
       {kLeastProbability, 100u, 1000u, kProbabilityOne / 3, kProbabilityOne / 2,
        kProbabilityOne - 1000, kProbabilityOne - kLeastProbability}) {
    expectRoundTrip(drawn(20000, probability, [&](auto&) { return probability; }));
  }
}

TEST(RangeCoder, roundTripsWhereEveryPredictionFails) {
  expectRoundTrip(Decisions(3000, {true, kLeastProbability}));
  expectRoundTrip(Decisions(3000, {false, kProbabilityOne - kLeastProbability}));
}

TEST(RangeCoder, predictionsThatAlwaysHoldCostNearlyNothing) {
  for (const Decision d :
       {Decision{true, kProbabilityOne - kLeastProbability}, Decision{false, kLeastProbability}}) {
    const Decisions decisions(20000, d);
    expectRoundTrip(decisions);
    EXPECT_LE(encoded(decisions).size(), 6u);
  }
}

/// Decisions after which one half is still inside the interval: a carry may still change all bytes
/// written so far.
class PendingCarry {
 public:
  explicit PendingCarry(uint64_t seed) : random_(seed) {}

  void stay() {
    const uint32_t probability =
        kLeastProbability +
        static_cast<uint32_t>(random_() % (kProbabilityOne - 2 * kLeastProbability + 1));
    const uint32_t split = (range_ >> 16) * probability;
    if (half_ == split) return;
    code(half_ < split, probability);
  }
  /// Chooses the interval's upper part, so that the carry happens, or its lower part.
  void resolve(bool up) {
    for (uint32_t probability = kLeastProbability;
         probability <= kProbabilityOne - kLeastProbability; ++probability) {
      const uint32_t split = (range_ >> 16) * probability;
      if (up ? split > half_ : split + (range_ >> 16) > half_) return code(!up, probability);
    }
  }
  [[nodiscard]] const Decisions& decisions() const { return decisions_; }

 private:
  void code(bool actual, uint32_t probability) {
    const uint32_t split = (range_ >> 16) * probability;
    decisions_.push_back({actual, probability});
    if (!actual) half_ -= split;
    range_ = actual ? split : range_ - split;
    for (; range_ < 1u << 24; range_ <<= 8) half_ <<= 8;
  }

  std::mt19937_64 random_;
  uint32_t range_ = 0xFFFFFFFFu,
           half_ = 0x80000000u;  // the coder's range, and where one half lies in it
  Decisions decisions_;
};

TEST(RangeCoder, carriesThroughLongRuns) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    PendingCarry pending(seed);
    for (uint64_t i = 0; i < seed * 3; ++i) pending.stay();
    for (bool up : {false, true}) {
      PendingCarry resolved = pending;
      resolved.resolve(up);
      auto decisions = resolved.decisions();
      const auto rest = drawn(seed % 50, seed, [](auto& r) { return 1000 + r() % 60000; });
      decisions.insert(decisions.end(), rest.begin(), rest.end());
      expectRoundTrip(decisions);
      const auto bytes = encoded(decisions);
      if (seed <= 50) continue;
      ASSERT_EQ(bytes[0], up ? std::byte{0x80} : std::byte{0x7F});
    }
  }
}

TEST(RangeCoder, roundTripsAllShortRuns) {
  for (int length = 0; length <= 12; ++length) {
    for (unsigned bits = 0; bits < 1u << length; ++bits) {
      for (uint32_t probability :
           {kLeastProbability, kProbabilityOne / 2, kProbabilityOne - kLeastProbability}) {
        Decisions decisions;
        for (int i = 0; i < length; ++i) decisions.push_back({(bits >> i & 1) != 0, probability});
        const auto bytes = encoded(decisions);
        RangeDecoder decoder(bytes);
        for (const auto& d : decisions) ASSERT_EQ(decoder.bit(false, probability), d.actual);
      }
    }
  }
}

TEST(RangeCoder, noDecisionsTakeNoBytes) {
  EXPECT_TRUE(encoded({}).empty());
}

TEST(RangeCoder, trailingZerosAreLeftOut) {
  EXPECT_TRUE(encoded(Decisions(7, {true, kProbabilityOne / 2})).empty());
  EXPECT_LE(encoded(Decisions(40, {true, kProbabilityOne / 2})).size(), 40u / 8)
      << "no more than the decisions cost";
  std::vector<std::byte> out(5, std::byte{0});
  RangeEncoder(out).finish();
  EXPECT_EQ(out.size(), 5u) << "bytes written before are kept";
}

TEST(RangeCoder, runsCanBeConcatenated) {
  const auto a = drawn(1000, 1, [](auto&r) { return 1000 + r() % 60000; }),
             b = drawn(1000, 2, [](auto&r) { return 1000 + r() % 60000; });
  std::vector<std::byte> out = encoded(a);
  const std::size_t end = out.size();
  RangeEncoder encoder(out);
  for (const auto& d : b) encoder.bit(d.actual, d.probability);
  encoder.finish();
  RangeDecoder decoder(std::span<const std::byte>(out).subspan(end));
  for (const auto& d : b) ASSERT_EQ(decoder.bit(false, d.probability), d.actual);
}

TEST(RangeCoder, bytesReadPastTheEndAreCounted) {
  RangeDecoder decoder{std::span<const std::byte>()};
  EXPECT_EQ(decoder.overrun(), 4u);
  std::size_t before = decoder.overrun();
  for (int i = 0; i < 8; ++i) (void)decoder.bit(false, kProbabilityOne / 2);
  EXPECT_EQ(decoder.overrun(), before + 1);
  for (int i = 0; i < 800; ++i) (void)decoder.bit(false, kProbabilityOne / 2);
  EXPECT_NEAR(static_cast<double>(decoder.overrun()), 105, 1);
}

TEST(RangeCoder, anyBytesDecode) {
  std::mt19937_64 random(3);
  for (int n = 0; n < 200; ++n) {
    std::vector<std::byte> noise(random() % 64);
    for (auto& b : noise) b = static_cast<std::byte>(random());
    RangeDecoder decoder(noise);
    for (int i = 0; i < 2000; ++i)
      (void)decoder.bit(
          false, static_cast<uint32_t>(kLeastProbability +
                                       random() % (kProbabilityOne - 2 * kLeastProbability + 1)));
  }
}

TEST(RangeCoder, meterAgreesWithTheEncodedSize) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const auto decisions =
        drawn(30000, seed, [](auto& r) { return kLeastProbability + r() % 65000; });
    EXPECT_NEAR(static_cast<double>(encoded(decisions).size()), metered(decisions) / 8, 5);
  }
}

}  // namespace
}  // namespace isostar
