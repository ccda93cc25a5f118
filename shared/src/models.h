// Adaptive probabilities, and their mixing in the log-odds domain (§6 of the paper leaves the models open).
// After M. Mahoney, "Adaptive weighing of context models" (PAQ, lpaq); integers only, so that every machine agrees.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "range_coder.h"

namespace isostar {

/// The logistic function and its inverse on integers: log-odds in 1/256 within [-2047, 2047], chances in 1/65536.
class Logistic {
 public:
  static constexpr int kBound = 2047;

  [[nodiscard]] static uint32_t squash(int logOdds) {
    return tables().squash[static_cast<std::size_t>(std::clamp(logOdds, -kBound, kBound) + kBound)];
  }
  [[nodiscard]] static int stretch(uint32_t chance) { return tables().stretch[chance >> 4]; }

 private:
  struct Tables {
    std::array<uint16_t, 2 * kBound + 1> squash{};
    std::array<int16_t, 4096> stretch{};

    constexpr Tables() {
      // 65536 / (1 + e^-x) at x = -8, -7.5, … 8; straight lines between.
      constexpr std::array<uint32_t, 33> kKnots{22,    36,    60,    98,    162,   267,   439,   720,   1179,  1921,  3108,
                                                4971,  7812,  11955, 17625, 24743, 32768, 40793, 47911, 53581, 57724, 60565,
                                                62428, 63615, 64357, 64816, 65097, 65269, 65374, 65438, 65476, 65500, 65514};
      for (int x = -kBound; x <= kBound; ++x) {
        const int at = x + 2048;
        const uint32_t a = kKnots[static_cast<std::size_t>(at >> 7)], b = kKnots[static_cast<std::size_t>((at >> 7) + 1)];
        const uint32_t value = a + ((b - a) * static_cast<uint32_t>(at & 127) + 64) / 128;
        squash[static_cast<std::size_t>(x + kBound)] =
            static_cast<uint16_t>(std::clamp(value, kLeastChance, kChanceOne - kLeastChance));
      }
      int x = -kBound;
      for (uint32_t i = 0; i < 4096; ++i) {
        while (x < kBound && squash[static_cast<std::size_t>(x + kBound)] < i * 16 + 8) ++x;
        stretch[i] = static_cast<int16_t>(x);
      }
    }
  };
  static const Tables& tables() {
    static constexpr Tables kTables{};
    return kTables;
  }
};

/// One adaptive probability: moves by 1/(n + 1.5) at its n-th decision, never by less than 1/limit.
class Chance {
 public:
  [[nodiscard]] uint32_t value() const { return std::clamp(state_ >> 16, kLeastChance, kChanceOne - kLeastChance); }

  template <int Limit>
  void learn(bool truth) {
    const uint32_t n = state_ & 1023;
    const uint32_t p = state_ >> 10;  // 22 bits
    const int32_t gap = static_cast<int32_t>(truth ? (1u << 22) - 1 : 0) - static_cast<int32_t>(p);
    const auto moved = static_cast<uint32_t>(static_cast<int32_t>(p) + ((gap >> 7) * reciprocalOf(n) >> 9));
    state_ = moved << 10 | (n < Limit ? n + 1 : n);
  }

  template <class Coder>
  bool bit(Coder& coder, bool truth) {
    const bool value = coder.bit(truth, this->value());
    learn<127>(value);
    return value;
  }

 private:
  static int32_t reciprocalOf(uint32_t n) {
    struct Table {
      std::array<int32_t, 1024> value{};
      constexpr Table() {
        for (int i = 0; i < 1024; ++i) value[static_cast<std::size_t>(i)] = 65535 * 2 / (2 * i + 3);
      }
    };
    static constexpr Table kTable{};
    return kTable.value[n];
  }

  uint32_t state_ = 1u << 31;
};

/// A decision seen in N contexts at once: their log-odds, weighed by weights that learn which context to trust.
template <int N>
class Mixer {
 public:
  using Weights = std::array<int32_t, N>;  // 1/16384, within [-8, 8]
  [[nodiscard]] static Weights fresh() {
    Weights w;
    w.fill(kOne * 10 / (N * 8));
    return w;
  }

  /// Chances forget beyond Limit decisions; weights move by error · log-odds / 2^Rate. All numbers fit 32 bits, so that
  /// the inputs are worked on side by side.
  template <int Limit, int Rate, class Coder>
  static bool bit(Coder& coder, bool truth, const std::array<Chance*, N>& contexts, Weights& weights) {
    std::array<int32_t, N> logOdds;
    for (int i = 0; i < N; ++i) logOdds[i] = Logistic::stretch(contexts[i]->value());
    int32_t sum = 0;
    for (int i = 0; i < N; ++i) sum += weights[i] * logOdds[i];
    const uint32_t chance = Logistic::squash(sum >> 14);
    const bool value = coder.bit(truth, chance);
    const int32_t error = (static_cast<int32_t>(value ? kChanceOne : 0) - static_cast<int32_t>(chance)) >> 2;
    for (int i = 0; i < N; ++i) {
      const int32_t moved = weights[i] + ((logOdds[i] * error + (1 << (Rate + 1))) >> (Rate + 2));
      weights[i] = std::clamp(moved, -8 * kOne, 8 * kOne);
    }
    for (int i = 0; i < N; ++i) contexts[i]->template learn<Limit>(value);
    return value;
  }

 private:
  static constexpr int32_t kOne = 1 << 14;
};

}  // namespace isostar
