#include "coding/geometry/domain_coder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "grid/refined_signs.h"
#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

constexpr int32_t kReach = 14;

/// Distances to a boundary, in steps, rounded down.
template <int D>
struct DistanceField : NoScalars {
  using Distance = std::function<double(const Coordinates<D>&)>;

  DistanceField(const Lattice<D>& lattice, Distance d) : table(lattice), distance(std::move(d)) {}

  [[nodiscard]] int32_t at(const Coordinates<D>& v) const {
    return std::clamp(static_cast<int32_t>(std::floor(distance(v))), -kReach, kReach - 1);
  }
  [[nodiscard]] int32_t domain(std::size_t brickIndex, std::size_t r, int x) const {
    return at(vertexOf<D>(table.brick(brickIndex), r * kBrickSide + static_cast<std::size_t>(x)));
  }

  BrickTable<D> table;
  Distance distance;
};

template <int D>
void expectDecoded(const Coordinates<D>& box, const DistanceField<D>& field) {
  const Lattice<D> lattice(box, 1);
  for (const auto& signField : signFields<D>(box)) {
    SCOPED_TRACE(signField.name);
    const auto signs = DenseSigns<D>(lattice, signField.positive).bricks();
    const auto active = activeBricks(signs);
    for (const bool diagonals : {false, true}) {
      Scalars<D> encoded(active.size()), found(active.size());
      const auto bytes = coded(signs, field, [&](auto& exchange) {
        DomainCoder<D>(kReach).code(exchange, signs, active, diagonals, encoded);
      });
      EXPECT_TRUE(decoded<D>(bytes, [&](auto& exchange) {
        DomainCoder<D>(kReach).code(exchange, signs, active, diagonals, found);
      }));
      Tube<D> tube;
      for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
        ASSERT_EQ(found.at(brickIndex).value, encoded.at(brickIndex).value);
        if (active[brickIndex] == 0) continue;
        tube.enter(signs, brickIndex, Members::AxisEnds);
        tube.forEach([&](int, std::size_t r, int x) {
          const int32_t distance = field.domain(brickIndex, r, x),
                        value = found.at(brickIndex)
                                    .value[r * kBrickSide + static_cast<std::size_t>(x)];
          ASSERT_EQ(value > 0, distance >= 0) << "each vertex has its side";
          ASSERT_TRUE(value == 2 * distance + 1 || std::abs(value) == 2 * kReach - 1)
              << "a distance is exact, or as far as it can be";
        });
      }
    }
  }
}

TEST(DomainCoder, decodesSidesAndDistances) {
  const Coordinates<2> plane{30, 17};
  expectDecoded<2>(plane, {Lattice<2>(plane, 1),
                           [](const auto& v) { return 8 * (0.6 * v[0] + 0.8 * v[1] - 14.3); }});
  const Coordinates<3> box{17, 9, 16};
  expectDecoded<3>(box, {Lattice<3>(box, 1), [](const auto& v) {
                           return 8 * (6.2 - std::hypot(v[0] - 8, v[1] - 5, v[2] - 7));
                         }});
  expectDecoded<3>(box, {Lattice<3>(box, 1), [](const auto& v) {
                           return static_cast<double>(scrambled<3>(v, 3) % 64) - 32;
                         }});
}

TEST(DomainCoder, codesTheDistancesOnBothSidesOfTheBoundary) {
  const Coordinates<3> box{15, 15, 15};
  const Lattice<3> lattice(box, 1);
  const auto signs = DenseSigns<3>(lattice, [](const auto& v) { return v[2] > 7; }).bricks();
  const auto active = activeBricks(signs);
  const DistanceField<3> field(lattice, [](const auto& v) { return 8 * (v[0] - 7.3); });
  Scalars<3> domain(active.size());
  (void)coded(signs, field, [&](auto& exchange) {
    DomainCoder<3>(kReach).code(exchange, signs, active, false, domain);
  });
  for (int32_t x = 0; x < 16; ++x) {
    const Coordinates<3> v{x, 5, 7};
    const int32_t value = domain.at(signs.table().brickIndexOf(v)).value[numberOf<3>(v)];
    const int32_t far = x > 7 ? 2 * kReach - 1 : 1 - 2 * kReach;
    EXPECT_EQ(value, x == 7 || x == 8 ? 2 * field.at(v) + 1 : far) << x;
  }
}

}  // namespace
}  // namespace isostar
