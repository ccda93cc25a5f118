// A fit finds linear fields exactly and curved ones nearly, and its arithmetic never overflows.
#include "estimate/local_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

namespace isostar {
namespace {

constexpr int kGradient = 4 * 12;  // 2^12 quantization steps per grid step

template <int D>
using Offset = std::array<int, D>;

/// Calls visit(offset from the brick's middle, value) for each value of a window.
template <int D, class Visit>
void forEachOf(ScalarWindow<D>& window, Visit visit) {
  for (std::size_t i = 0; i < window.value.size(); ++i) {
    Offset<D> offset;
    std::size_t digits = i;
    for (int a = 0; a < D; ++a, digits /= kBrickSide + 2)
      offset[static_cast<std::size_t>(a)] =
          static_cast<int>(digits % (kBrickSide + 2)) - 1 - kBrickSide / 2;
    visit(offset, window.value[i]);
  }
}

/// Scalars of a field, known to 2^log2Width quantization steps, in half steps.
template <int D, class Field>
ScalarWindow<D> sampledWindow(Field field, int log2Width) {
  ScalarWindow<D> window;
  forEachOf<D>(window, [&](const Offset<D>& offset, int32_t& value) {
    const auto whole = static_cast<int64_t>(std::floor(std::abs(field(offset))));
    const auto middle =
        static_cast<int32_t>(2 * (whole >> log2Width << log2Width) + (int64_t{1} << log2Width));
    value = field(offset) > 0 ? middle : -middle;
  });
  return window;
}

template <int D>
LocalFit<D> fitAtMiddle(const ScalarWindow<D>& scalars, bool positive) {
  FitWindow<D> window;
  window.load(scalars, kGradient);
  std::size_t r = 0;
  for (int a = D - 1; a >= 1; --a) r = r * kBrickSide + kBrickSide / 2;
  return LocalFit<D>::of(window, r, kBrickSide / 2, positive);
}

/// A fit's magnitude in grid steps: fits scale the gradient of a grid step to 2^14.
double steps(int32_t magnitude) {
  return magnitude / 16384.0;
}

template <int D>
void expectLinearFieldsFound() {
  std::mt19937 random(D);
  std::uniform_real_distribution<double> slope(-4096, 4096), level(500, 4000);
  for (int n = 0; n < 50; ++n) {
    std::array<double, D> gradient;
    for (double& g : gradient) g = slope(random);
    const double here = level(random);
    const auto linear = [&](const Offset<D>& offset) {
      double value = here;
      for (std::size_t a = 0; a < D; ++a) value += gradient[a] * offset[a];
      return value;
    };
    const auto fit = fitAtMiddle<D>(sampledWindow<D>(linear, 2), true);
    EXPECT_EQ(fit.known, 2 * D * D);
    EXPECT_NEAR(steps(fit.linear), here / 4096, 0.01);
    EXPECT_NEAR(steps(fit.curved), here / 4096, 0.01);
  }
}

TEST(LocalFit, findsLinearFields) {
  expectLinearFieldsFound<2>();
  expectLinearFieldsFound<3>();
  expectLinearFieldsFound<4>();
}

TEST(LocalFit, findsLinearFieldsWhereOneSideIsUnknown) {
  const auto linear = [](const Offset<3>& offset) {
    return 1500.0 + 3000 * offset[0] - 2000 * offset[2];
  };
  auto scalars = sampledWindow<3>(linear, 2);
  forEachOf<3>(scalars, [](const Offset<3>& offset, int32_t& value) {
    if (offset[0] > 0 || (offset[1] > 0 && offset[2] > 0)) value = Scalars<3>::kUnknown;
  });
  const auto fit = fitAtMiddle<3>(scalars, true);
  EXPECT_LT(fit.known, 18);
  EXPECT_NEAR(steps(fit.linear), 1500.0 / 4096, 0.01);
}

TEST(LocalFit, followsCurvedFields) {
  const auto ball = [](const Offset<3>& offset) {
    return 4096 * (12.3 - std::hypot(offset[0] + 7, offset[1] + 5, offset[2] + 8.5));
  };
  const double here = 12.3 - std::hypot(7, 5, 8.5);
  const auto fit = fitAtMiddle<3>(sampledWindow<3>(ball, 4), here > 0);
  EXPECT_GT(std::abs(steps(fit.linear) - std::abs(here)), 0.02);
  EXPECT_NEAR(steps(fit.curved), std::abs(here), 0.01);
}

TEST(LocalFit, needsEnoughNeighbours) {
  ScalarWindow<3> scalars;
  scalars.value.fill(Scalars<3>::kUnknown);
  EXPECT_EQ(fitAtMiddle<3>(scalars, true).known, 0);
}

/// A scalar in half quantization steps; `sign` is 1 or -1.
using Extreme = std::function<int32_t(std::mt19937& random, int sign)>;

/// The largest values of the narrowest and the widest intervals, and random bits.
const std::vector<Extreme> kExtremes{
    [](std::mt19937& random, int) {
      return std::max(static_cast<int32_t>(random()), -INT32_MAX) | 1;
    },
    [](std::mt19937&, int sign) { return sign * INT32_MAX; },
    [](std::mt19937&, int sign) { return sign * (1 << 29); },
    [](std::mt19937& random, int sign) { return random() % 2 != 0 ? sign * (1 << 30) : sign; },
    [](std::mt19937& random, int sign) {
      return random() % 3 != 0 ? Scalars<3>::kUnknown : sign * (3 << 28);
    },
    [](std::mt19937& random, int sign) {
      return random() % 4 != 0 ? Scalars<3>::kUnknown
                               : sign * static_cast<int32_t>(1u << random() % 31);
    },
};

/// Fits at each vertex of a brick; signs alternate from vertex to vertex, or are random.
template <int D>
void expectWithinRange(int rounds) {
  constexpr int kNoGradient = 255;
  std::mt19937 random(D);
  ScalarWindow<D> scalars;
  FitWindow<D> window;
  for (int n = 0; n < rounds; ++n) {
    for (const Extreme& extreme : kExtremes) {
      forEachOf<D>(scalars, [&](const Offset<D>& offset, int32_t& value) {
        const bool odd = n % 2 == 0 ? std::accumulate(offset.begin(), offset.end(), 0) % 2 != 0
                                    : random() % 2 != 0;
        value = extreme(random, odd ? 1 : -1);
      });
      for (const int gradient : {0, 3, 40, 4 * 31, kNoGradient}) {
        window.load(scalars, gradient);
        for (std::size_t r = 0; r < power(kBrickSide, D - 1); ++r) {
          for (int x = 0; x < kBrickSide; ++x) {
            const auto fit = LocalFit<D>::of(window, r, x, n % 3 == 0);
            ASSERT_TRUE(fit.linear >= 0 && fit.linear <= 2 * FitWindow<D>::kMost &&
                        fit.curved >= 0 && fit.curved <= 2 * FitWindow<D>::kMost);
          }
        }
      }
    }
  }
}

TEST(LocalFit, staysWithinItsRange) {
  expectWithinRange<2>(60);
  expectWithinRange<3>(12);
  expectWithinRange<4>(2);
}

}  // namespace
}  // namespace isostar
