#include "coding/geometry/fit_coder.h"

#include <gtest/gtest.h>

#include <random>

namespace isostar {
namespace {

constexpr int kGradient = 4 * 12;  // 2^12 quantization steps per grid step
constexpr int kLog2Width = 9;      // of the intervals that are halved

struct Half {
  bool upper;
  uint32_t middle;
};

/// The interval of 2^kLog2Width steps that holds a scalar in half steps, and the half that does.
Half halfOf(int32_t scalar) {
  const uint32_t steps = static_cast<uint32_t>(std::abs(scalar)) / 2;
  const uint32_t middle = 2 * (steps >> kLog2Width << kLog2Width) + (1u << kLog2Width);
  return {static_cast<uint32_t>(std::abs(scalar)) >= middle, middle};
}

/// Codes the halves of all vertices of a brick. Returns what the decoder sees, in order.
template <class Coder>
std::vector<bool> codeBrick(FitCoder<2>& fit, BitModel& byPairs, Coder& coder,
                            const ScalarWindow<2>& scalars) {
  std::vector<bool> seen;
  fit.enter(scalars, kGradient);
  for (std::size_t r = 0; r < kBrickSide; ++r) {
    for (int x = 0; x < kBrickSide; ++x) {
      const int32_t scalar = scalars.value[static_cast<std::size_t>(ScalarWindow<2>::index(r, x))];
      const auto [upper, middle] = halfOf(scalar);
      fit.find(r, x, scalar > 0);
      seen.push_back(fit.upper(coder, upper, middle, kLog2Width - 1, 3, byPairs));
      fit.update(r, x, scalar);
    }
  }
  return seen;
}

/// A linear field that is positive in the whole window.
ScalarWindow<2> linearWindow(std::mt19937& random) {
  std::uniform_real_distribution<double> slope(-4096, 4096);
  const double a = slope(random), b = slope(random);
  ScalarWindow<2> window;
  for (std::size_t i = 0; i < window.value.size(); ++i) {
    const double x = static_cast<double>(i % 10) - 5, y = static_cast<double>(i / 10) - 5;
    window.value[i] = 2 * static_cast<int32_t>(50000 + a * x + b * y) + 1;
  }
  return window;
}

ScalarWindow<2> noiseWindow(std::mt19937& random) {
  ScalarWindow<2> window;
  for (int32_t& value : window.value) {
    value = (static_cast<int32_t>(random() % 20001) - 10000) | 1;
  }
  return window;
}

TEST(FitCoder, decodesWhatWasEncoded) {
  std::mt19937 random(2);
  std::vector<ScalarWindow<2>> windows;
  for (int n = 0; n < 20; ++n)
    windows.push_back(n % 2 == 0 ? linearWindow(random) : noiseWindow(random));
  std::vector<std::byte> bytes;
  std::vector<std::vector<bool>> encoded;
  {
    FitCoder<2> fit;
    BitModel byPairs;
    RangeEncoder coder(bytes);
    for (const auto& window : windows) encoded.push_back(codeBrick(fit, byPairs, coder, window));
    coder.finish();
  }
  FitCoder<2> fit;
  BitModel byPairs;
  RangeDecoder coder(bytes);
  for (std::size_t n = 0; n < windows.size(); ++n)
    EXPECT_EQ(codeBrick(fit, byPairs, coder, windows[n]), encoded[n]);
}

TEST(FitCoder, predictsTheHalvesOfLinearFields) {
  std::mt19937 random(7);
  FitCoder<2> fit;
  BitModel byPairs;
  Meter first, later;
  constexpr int kBricks = 60;
  for (int n = 0; n < kBricks; ++n)
    codeBrick(fit, byPairs, n < kBricks / 2 ? first : later, linearWindow(random));
  EXPECT_LT(later.bits() / (kBricks / 2 * 64), 0.3) << "bits per decision";
}

}  // namespace
}  // namespace isostar
