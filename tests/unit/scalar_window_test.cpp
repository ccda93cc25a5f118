#include "scalars/scalar_window.h"

#include <gtest/gtest.h>

#include "dense_signs.h"

namespace isostar {
namespace {

/// A different value for each vertex.
template <int D>
int32_t valueAt(const Coordinates<D>& v) {
  int32_t value = 1;
  for (int a = 0; a < D; ++a) value = value * 101 + v[a];
  return value;
}

/// The window of each brick holds the values of its vertices and of those one step around. Bricks
/// without scalars, and those beyond the table, are unknown.
template <int D>
void expectWindows(const Coordinates<D>& box) {
  const BrickTable<D> table{Lattice<D>(box, 1)};
  Scalars<D> scalars(table.total());
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex) {
    if (brickIndex % 5 == 4) continue;
    auto& brick = scalars.writable(brickIndex);
    for (std::size_t n = 0; n < brick.value.size(); ++n)
      brick.value[n] = valueAt<D>(vertexOf<D>(table.brick(brickIndex), n));
  }
  const auto expected = [&](const Coordinates<D>& v) {
    for (int a = 0; a < D; ++a) {
      if (v[a] < 0 || v[a] >= table.count(a) * kBrickSide) return Scalars<D>::kUnknown;
    }
    return scalars.has(table.brickIndexOf(v)) ? valueAt<D>(v) : Scalars<D>::kUnknown;
  };
  ScalarWindow<D> window;
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex) {
    const auto brick = table.brick(brickIndex);
    window.load(scalars, table, brick);
    for (std::size_t number = 0; number < power(kBrickSide, D); ++number) {
      const auto v = vertexOf<D>(brick, number);
      const int32_t* here = &window.value[static_cast<std::size_t>(
          ScalarWindow<D>::index(number / kBrickSide, static_cast<int>(number % kBrickSide)))];
      ASSERT_EQ(*here, expected(v));
      for (int a = 0; a < D; ++a) {
        for (const int step : {-1, 1}) {
          auto next = v;
          next[a] += step;
          ASSERT_EQ(here[step * ScalarWindow<D>::stride(a)], expected(next))
              << testing::PrintToString(v) << ", axis " << a;
        }
      }
    }
  }
}

TEST(ScalarWindow, holdsABrickAndItsSurroundings) {
  expectWindows<2>({7, 7});
  expectWindows<2>({25, 30});
  expectWindows<3>({8, 20, 17});
  expectWindows<4>({9, 8, 3, 16});
}

}  // namespace
}  // namespace isostar
