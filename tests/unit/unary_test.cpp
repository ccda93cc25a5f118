#include "entropy/unary.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace isostar {
namespace {

/// Decisions by number, recorded by an encoder and replayed by a decoder.
class Decisions {
 public:
  auto recorder() {
    return [this](int n, bool answer) {
      all_.emplace_back(n, answer);
      return answer;
    };
  }
  /// Ignores the actual answers, as a range decoder does, and expects the same numbers.
  auto player() {
    return [this](int n, bool) {
      EXPECT_LT(next_, all_.size());
      EXPECT_EQ(all_[next_].first, n);
      return all_[next_++].second;
    };
  }
  [[nodiscard]] bool allPlayed() const { return next_ == all_.size(); }
  [[nodiscard]] const std::vector<std::pair<int, bool>>& all() const { return all_; }

 private:
  std::vector<std::pair<int, bool>> all_;
  std::size_t next_ = 0;
};

TEST(Unary, roundTripsEachValueInItsRange) {
  for (int least = -2; least < 3; ++least) {
    for (int most = least; most < least + 9; ++most) {
      for (int value = least; value <= most; ++value) {
        Decisions decisions;
        EXPECT_EQ(codeUnary(value, least, most, decisions.recorder()), value);
        EXPECT_EQ(codeUnary(0, least, most, decisions.player()), value);
        EXPECT_TRUE(decisions.allPlayed());
      }
    }
  }
}

TEST(Unary, needsNoDecisionForTheEndOfTheRange) {
  Decisions decisions;
  codeUnary(3, 0, 3, decisions.recorder());
  EXPECT_EQ(decisions.all(), (std::vector<std::pair<int, bool>>{{0, true}, {1, true}, {2, true}}));
}

TEST(Unary, clampsValuesOutsideTheRange) {
  Decisions decisions;
  EXPECT_EQ(codeUnary(99, 2, 5, decisions.recorder()), 5);
  EXPECT_EQ(codeUnary(-99, 2, 5, decisions.recorder()), 2);
}

TEST(SignedUnary, roundTripsEachValue) {
  for (int most = 1; most < 9; ++most) {
    for (int value = -most; value <= most; ++value) {
      Decisions decisions;
      EXPECT_EQ(codeSignedUnary(value, most, decisions.recorder()), value);
      EXPECT_EQ(codeSignedUnary(0, most, decisions.player()), value);
      EXPECT_TRUE(decisions.allPlayed());
    }
  }
}

TEST(SignedUnary, codesZeroThenTheSignThenTheSize) {
  Decisions decisions;
  codeSignedUnary(-3, 8, decisions.recorder());
  EXPECT_EQ(decisions.all(), (std::vector<std::pair<int, bool>>{
                                 {0, true}, {1, true}, {2, true}, {3, true}, {4, false}}));
}

}  // namespace
}  // namespace isostar
