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

/// Decodes what was encoded from a buffer of its very length, so that the address sanitizer sees an
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

/// Decisions of a source whose chances are drawn by `chance` and come true that often.
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

TEST(RangeCoder, anyProbabilities) {
  const uint32_t span = kProbabilityOne - 2 * kLeastProbability + 1;
  for (uint64_t seed = 0; seed < 20; ++seed)
    expectRoundTrip(drawn(5000, seed, [&](auto& r) { return kLeastProbability + r() % span; }));
}

TEST(RangeCoder, eachFixedProbability) {
  for (uint32_t probability :
       {kLeastProbability, 100u, 1000u, kProbabilityOne / 3, kProbabilityOne / 2,
        kProbabilityOne - 1000, kProbabilityOne - kLeastProbability}) {
    expectRoundTrip(drawn(20000, probability, [&](auto&) { return probability; }));
  }
}

TEST(RangeCoder, expectationsThatFailEachTime) {
  expectRoundTrip(Decisions(3000, {true, kLeastProbability}));
  expectRoundTrip(Decisions(3000, {false, kProbabilityOne - kLeastProbability}));
}

TEST(RangeCoder, expectationsThatHoldEachTimeCostNearlyNothing) {
  for (const Decision d :
       {Decision{true, kProbabilityOne - kLeastProbability}, Decision{false, kLeastProbability}}) {
    const Decisions decisions(20000, d);
    expectRoundTrip(decisions);
    EXPECT_LE(encoded(decisions).size(), 6u);
  }
}

/// Decisions after which the interval still holds one half in its inside: all bytes written so far
/// may yet change by a carry.
class OnTheFence {
 public:
  explicit OnTheFence(uint64_t seed) : random_(seed) {}

  void stay() {
    const uint32_t probability =
        kLeastProbability +
        static_cast<uint32_t>(random_() % (kProbabilityOne - 2 * kLeastProbability + 1));
    const uint32_t split = (range_ >> 16) * probability;
    if (half_ == split) return;
    code(half_ < split, probability);
  }
  /// The interval's upper part, above one half: the carry comes; or its lower part: it does not.
  void jump(bool up) {
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
           half_ = 0x80000000u;  // as the coder's, and where one half lies in it
  Decisions decisions_;
};

TEST(RangeCoder, carriesThroughLongRuns) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    OnTheFence fence(seed);
    for (uint64_t i = 0; i < seed * 3; ++i) fence.stay();
    for (bool up : {false, true}) {
      OnTheFence jumped = fence;
      jumped.jump(up);
      auto decisions = jumped.decisions();
      const auto rest = drawn(seed % 50, seed, [](auto& r) { return 1000 + r() % 60000; });
      decisions.insert(decisions.end(), rest.begin(), rest.end());
      expectRoundTrip(decisions);
      const auto bytes = encoded(decisions);
      if (seed <= 50) continue;
      ASSERT_EQ(bytes[0], up ? std::byte{0x80} : std::byte{0x7F});
    }
  }
}

TEST(RangeCoder, shortRunsOfAllKinds) {
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

TEST(RangeCoder, nothingIsNoBytes) {
  EXPECT_TRUE(encoded({}).empty());
}

TEST(RangeCoder, trailingZerosAreLeftOut) {
  EXPECT_TRUE(encoded(Decisions(7, {true, kProbabilityOne / 2})).empty());
  EXPECT_LE(encoded(Decisions(40, {true, kProbabilityOne / 2})).size(), 40u / 8)
      << "no more than what the decisions cost";
  std::vector<std::byte> out(5, std::byte{0});
  RangeEncoder(out).finish();
  EXPECT_EQ(out.size(), 5u) << "what stood before belongs to others";
}

TEST(RangeCoder, runsStandBehindOneAnother) {
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

TEST(RangeCoder, readingOnIsCounted) {
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

TEST(RangeCoder, meterAgreesWithTheSize) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const auto decisions =
        drawn(30000, seed, [](auto& r) { return kLeastProbability + r() % 65000; });
    EXPECT_NEAR(static_cast<double>(encoded(decisions).size()), metered(decisions) / 8, 5);
  }
}

}  // namespace
}  // namespace isostar
