#include "grid/halo_window.h"

#include <gtest/gtest.h>

#include "dense_signs.h"

namespace isostar {
namespace {

/// A window over bricks of 4 items on a side; gather() is protected.
template <int D>
struct SmallWindow : HaloWindow<D, int, 4> {
  using Items = std::array<int, power(4, D)>;

  void load(const std::vector<Items>& bricks, const BrickTable<D>& table,
            const Coordinates<D>& brick) {
    static constexpr Items kNothing{};
    this->gather(table, brick, kNothing.data(),
                 [&](std::size_t brickIndex) { return bricks[brickIndex].data(); });
  }
};

/// Each item is its own position, and 0 beyond the table.
template <int D>
int itemAt(const Coordinates<D>& position) {
  int item = 1;
  for (int a = 0; a < D; ++a) item = item * 50 + position[a];
  return item;
}

template <int D>
void expectGathered(const Coordinates<D>& box) {
  const BrickTable<D> table{Lattice<D>(box, 1)};
  std::vector<typename SmallWindow<D>::Items> bricks(table.total());
  Coordinates<D> side;
  side.fill(3);
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    std::size_t n = 0;
    forVertices(Lattice<D>(side, 1), [&](Coordinates<D> v) {
      for (int a = 0; a < D; ++a) v[a] += 4 * table.brick(b)[a];
      bricks[b][n++] = itemAt<D>(v);
    });
  }
  side.fill(SmallWindow<D>::kSide - 1);
  SmallWindow<D> window;
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    window.load(bricks, table, table.brick(b));
    forVertices(Lattice<D>(side, 1), [&](const Coordinates<D>& inWindow) {
      int at = 0;
      bool inside = true;
      Coordinates<D> position;
      for (int a = 0; a < D; ++a) {
        at += inWindow[a] * SmallWindow<D>::stride(a);
        position[a] = 4 * table.brick(b)[a] + inWindow[a] - 1;
        inside = inside && position[a] >= 0 && position[a] < 4 * table.count(a);
      }
      ASSERT_EQ(window.value[static_cast<std::size_t>(at)], inside ? itemAt<D>(position) : 0);
    });
  }
}

TEST(HaloWindow, gathersABrickAndOneItemAround) {
  expectGathered<2>({7, 7});
  expectGathered<2>({30, 20});
  expectGathered<3>({23, 9, 16});
  expectGathered<4>({8, 9, 0, 23});
}

}  // namespace
}  // namespace isostar
