// Adaptive bit models and their mixing in the log-odds domain (§6 of the paper leaves the models
// open). After M. Mahoney, "Adaptive weighing of context models" (PAQ, lpaq). Integers only, so
// that all machines compute the same probabilities.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "entropy/range_coder.h"
#include "util/cold_path.h"
#include "util/simd.h"

namespace isostar {

/// The logistic function and its inverse on integers: log-odds in units of 1/256 within [-2047,
/// 2047], probabilities in units of 1/65536.
class Logistic {
 public:
  static constexpr int kBound = 2047;

  /// The probability of log-odds, which are clamped to [-kBound, kBound] first.
  [[nodiscard]] static uint32_t squash(int logOdds) {
    return tables().squash[static_cast<std::size_t>(std::clamp(logOdds, -kBound, kBound) + kBound)];
  }
  /// The log-odds of a probability below kProbabilityOne.
  [[nodiscard]] static int stretch(uint32_t probability) {
    return tables().stretch[probability >> 4];
  }

 private:
  struct Tables {
    std::array<uint16_t, 2 * kBound + 1> squash{};
    std::array<int16_t, 4096> stretch{};

    /// Fills the tables at run time: as constants they would be an eighth of a small decoder.
    /// `volatile` keeps the compiler from evaluating the loop at compile time.
    Tables() {
      const volatile int first = -kBound;
      // 65536 / (1 + e^-x) at x = -8, -7.5, … 8, with linear interpolation in between.
      constexpr std::array<uint32_t, 33> kKnots{
          22,    36,    60,    98,    162,   267,   439,   720,   1179,  1921,  3108,
          4971,  7812,  11955, 17625, 24743, 32768, 40793, 47911, 53581, 57724, 60565,
          62428, 63615, 64357, 64816, 65097, 65269, 65374, 65438, 65476, 65500, 65514};
      for (int x = first; x <= kBound; ++x) {
        const int at = x + 2048;
        const uint32_t a = kKnots[static_cast<std::size_t>(at >> 7)],
                       b = kKnots[static_cast<std::size_t>((at >> 7) + 1)];
        const uint32_t value = a + ((b - a) * static_cast<uint32_t>(at & 127) + 64) / 128;
        squash[static_cast<std::size_t>(x + kBound)] = static_cast<uint16_t>(
            std::clamp(value, kLeastProbability, kProbabilityOne - kLeastProbability));
      }
      int x = -kBound;
      for (uint32_t i = 0; i < 4096; ++i) {
        while (x < kBound && squash[static_cast<std::size_t>(x + kBound)] < i * 16 + 8) ++x;
        stretch[i] = static_cast<int16_t>(x);
      }
    }
  };
  static const Tables kTables;
  static const Tables& tables() { return kTables; }
};

inline const Logistic::Tables Logistic::kTables;

/// One adaptive probability. Its first decisions move it by 2/3, 1/3, 1/4, … of the way towards
/// their value, later ones by no less than about 1/Limit. The update needs no tables, so that
/// several models are updated as one vector.
class BitModel {
 public:
  /// The probability of `true`, in units of 1/65536.
  [[nodiscard]] uint32_t value() const {
    return std::clamp(state_ >> 16, kLeastProbability, kProbabilityOne - kLeastProbability);
  }

  /// Codes one decision with this model alone, and learns from it.
  template <class Coder>
  bool bit(Coder& coder, bool actual) {
    return hotBit(coder, actual);
  }
  /// The same, inlined: for the places where most decisions are.
  template <class Coder>
  ISOSTAR_HOT bool hotBit(Coder& coder, bool actual) {
    const bool value = coder.bit(actual, this->value());
    learn<127>(value);
    return value;
  }

  template <int Limit>
  void learn(bool decision) {
    state_ = static_cast<uint32_t>(learned<Limit>(static_cast<int32_t>(state_), decision));
  }

 private:
  template <int N>
  friend class Mixer;

  /// The lower bits of the state are the rate, the upper 18 the probability.
  static constexpr int kRateBits = 14;
  static constexpr int32_t kFirstRate = (1 << kRateBits) * 2 / 3;

  /// The state after a decision. State is an integer, or a vector of integers.
  template <int Limit, class State>
  static State learned(State state, bool decision) {
    constexpr int32_t kLeastRate = (1 << (kRateBits + 1)) / (2 * Limit + 3);
    const State rate = state & ((1 << kRateBits) - 1);
    const State p = (state >> kRateBits) & ((1 << 18) - 1);
    const State gap = (decision ? (1 << 18) - 1 : 0) - p;
    const State moved = p + (((gap >> 1) * rate + (1 << (kRateBits - 2))) >> (kRateBits - 1));
    // 1/(n + 1) is nearly 1/n - 3/4 · (1/n)².
    const State slower = rate - ((rate * rate * 3 + (1 << (kRateBits + 1))) >> (kRateBits + 2));
    return moved << kRateBits | (slower < kLeastRate ? State{} + kLeastRate : slower);
  }

  uint32_t state_ = 1u << 31 | kFirstRate;
};

/// Codes one decision in up to four contexts at once: their log-odds are summed with weights, which
/// learn how far to trust each context.
template <int N>
class Mixer {
 public:
  static_assert(N <= 4);

  using Weights = std::array<int32_t, 4>;  // in units of 1/16384, within [-8, 8]
  /// For contexts alone.
  [[nodiscard]] static Weights initialWeights() {
    Weights w{};
    std::fill_n(w.begin(), N, kOne * 10 / (N * 8));
    return w;
  }
  /// For contexts and an estimate, which counts while the contexts have not learned anything.
  [[nodiscard]] static Weights initialWeightsWithEstimate() {
    static_assert(N < 4);
    Weights w{};
    std::fill_n(w.begin(), N, kOne / N);
    w[N] = kOne / 2;
    return w;
  }

  /// Codes a decision, then updates the models of its contexts and the weights. Models average over
  /// about Limit decisions; weights move by error · log-odds / 2^Rate. All intermediate values fit
  /// 32 bits.
  ///
  /// With fewer than four contexts, `estimate` may add log-odds in units of 1/256 that do not
  /// adapt; they use the weight after the contexts' ones.
  template <int Limit, int Rate, class Coder>
  static bool bit(Coder& coder, bool actual, const std::array<BitModel*, N>& contexts,
                  Weights& weights, int32_t estimate = 0) {
    const auto state = [&](int i) {
      return i < N ? contexts[static_cast<std::size_t>(i % N)]->state_ : 0;
    };
    const std::array<uint32_t, 4> states{state(0), state(1), state(2), state(3)};
    const auto logOdds = [&](int i) {
      return i < N ? Logistic::stretch(states[static_cast<std::size_t>(i)] >> 16)
                   : std::clamp(estimate, -Logistic::kBound, Logistic::kBound);
    };
    const int32_t a = logOdds(0), b = logOdds(1), c = logOdds(2), d = logOdds(3);
    const uint32_t probability = Logistic::squash(
        (weights[0] * a + weights[1] * b + (weights[2] * c + weights[3] * d)) >> 14);
    const bool value = coder.bit(actual, probability);
    const int32_t error =
        (static_cast<int32_t>(value ? kProbabilityOne : 0) - static_cast<int32_t>(probability)) >>
        2;
    Lanes trust = lanesAt(weights.data());
    trust += (Lanes{a, b, c, d} * error + (1 << (Rate + 1))) >> (Rate + 2);
    trust = clamped(trust, 8 * kOne);
    std::memcpy(weights.data(), &trust, sizeof trust);
    const Lanes known{static_cast<int32_t>(states[0]), static_cast<int32_t>(states[1]),
                      static_cast<int32_t>(states[2]), static_cast<int32_t>(states[3])};
    const Lanes learned = BitModel::learned<Limit>(known, value);
    for (int i = 0; i < N; ++i)
      contexts[static_cast<std::size_t>(i)]->state_ = static_cast<uint32_t>(learned[i]);
    return value;
  }

 private:
  static constexpr int32_t kOne = 1 << 14;
};

}  // namespace isostar
