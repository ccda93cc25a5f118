#include "coding/geometry/exponent_coder.h"
#include "coding/geometry/magnitude_coder.h"
#include "grid/refined_signs.h"

#include <gtest/gtest.h>

#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

/// Whole numbers at the vertices; positive above zero. Magnitudes: 0 for 1 and for 0.
template <int D>
struct WholeField {
  using Value = std::function<int32_t(const Coordinates<D>&)>;

  WholeField(const Lattice<D>& lattice, Value v) : table(lattice), value(std::move(v)) {}

  [[nodiscard]] uint32_t magnitudeAt(const Coordinates<D>& v) const {
    const int32_t x = value(v);
    return static_cast<uint32_t>(x > 0 ? x - 1 : -x);
  }
  [[nodiscard]] Coordinates<D> vertex(std::size_t brickIndex, std::size_t r, int x) const {
    Coordinates<D> v = table.brick(brickIndex);
    for (int32_t& c : v) c *= kBrickSide;
    v[0] += x;
    for (int a = 1; a < D; ++a, r /= kBrickSide) v[a] += static_cast<int32_t>(r % kBrickSide);
    return v;
  }
  [[nodiscard]] uint32_t magnitude(std::size_t brickIndex, std::size_t r, int x) const {
    return magnitudeAt(vertex(brickIndex, r, x));
  }
  [[nodiscard]] int gradient(std::size_t brickIndex) const {
    return brickIndex % 3 == 0 ? steepest : 37;
  }
  [[nodiscard]] bool selected(std::size_t brickIndex) const { return brickIndex % 2 == 0; }

  BrickTable<D> table;
  Value value;
  int steepest = 40;
};

template <int D>
struct Named {
  std::string name;
  typename WholeField<D>::Value value;
};

template <int D>
std::vector<Named<D>> wholeFields() {
  auto ball = [](const Coordinates<D>& v) {
    int32_t squares = 0;
    for (int32_t x : v) squares += (x - 8) * (x - 8);
    return 40 - squares;
  };
  return {{"ball", [=](const auto& v) { return 10 * ball(v); }},
          {"bits", [=](const auto& v) { return ball(v) > 0 ? 1 : 0; }},
          {"noise",
           [](const auto& v) { return static_cast<int32_t>(scrambled<D>(v, 7) % 2001) - 1000; }},
          {"large",
           [=](const auto& v) {
             return (ball(v) > 0 ? 1 : -1) * static_cast<int32_t>(scrambled<D>(v, 9) >> 36);
           }},
          {"all scales", [=](const auto& v) {
             return (ball(v) > 0 ? 1 : -1) * (int32_t{1} << scrambled<D>(v, 8) % 29);
           }}};
}

/// What one side knows, and the passes told one after the other.
template <int D>
struct Side {
  explicit Side(const Signs<D>& s) : signs(s), active(activeBricks(s)), scalars(active.size()) {}

  const Signs<D>& signs;
  std::vector<uint8_t> active;
  Scalars<D> scalars;
  ExponentCoder<D> exponents;
  MagnitudeCoder<D> magnitudes;
};

template <int D>
bool equal(const Side<D>& a, const Side<D>& b) {
  for (std::size_t brickIndex = 0; brickIndex < a.active.size(); ++brickIndex) {
    if (a.scalars.has(brickIndex) != b.scalars.has(brickIndex)) return false;
    if (a.scalars.at(brickIndex).value != b.scalars.at(brickIndex).value) return false;
  }
  return true;
}

/// A field told and heard, pass by pass.
template <int D>
class Coding {
 public:
  Coding(const Coordinates<D>& box, typename WholeField<D>::Value value)
      : field_(Lattice<D>(box, 1), std::move(value)),
        signs_(DenseSigns<D>(Lattice<D>(box, 1), [&](const auto& v) { return field_.value(v) > 0; })
                   .bricks()),
        mine_(signs_),
        theirs_(signs_) {}

  void exponents(Members members, int exponentRange) {
    pass([=](auto& exchange, Side<D>& side) {
      side.exponents.code(exchange, side.signs, side.scalars, members, exponentRange, side.active);
    });
  }
  void magnitudePass(Members members, const typename MagnitudeCoder<D>::Allowed& allowed, int most,
                     bool selective) {
    pass([=](auto& exchange, Side<D>& side) {
      side.magnitudes.code(exchange, side.signs, side.scalars, {members, allowed, most, selective},
                           side.active);
    });
  }

  void steepen(int gradient) { field_.steepest = gradient; }

  /// Calls visit(vertex, brick, its number in it) for each vertex of a class.
  template <class Visit>
  void forMembers(Members members, Visit visit) const {
    Tube<D> tube;
    for (std::size_t brickIndex = 0; brickIndex < theirs_.active.size(); ++brickIndex) {
      if (theirs_.active[brickIndex] == 0) continue;
      tube.enter(signs_, brickIndex, members);
      tube.forEach([&](int, std::size_t r, int x) {
        visit(field_.vertex(brickIndex, r, x), theirs_.scalars.at(brickIndex),
              r * kBrickSide + static_cast<std::size_t>(x));
      });
    }
  }

  void expectActualInside(Members members) const {
    forMembers(members, [&](const Coordinates<D>& v, const auto& brick, std::size_t at) {
      ASSERT_TRUE(brick.knows(at));
      const uint32_t actual = field_.magnitudeAt(v);
      ASSERT_LE(brick.low(at), actual) << testing::PrintToString(v);
      ASSERT_LT(actual, brick.low(at) + (uint64_t{1} << brick.width(at)))
          << testing::PrintToString(v);
      ASSERT_EQ(brick.value[at] > 0, field_.value(v) > 0);
    });
  }

  /// The furthest that a crossing of an axis edge is from its place, in parts of the edge.
  [[nodiscard]] double furthest() const {
    double most = 0;
    forMembers(Members::AxisEnds, [&](const Coordinates<D>& v, const auto& brick, std::size_t at) {
      for (int a = 0; a < D; ++a) {
        auto next = v;
        if (++next[a] > signs_.lattice().last[a] || signs_.at(v) == signs_.at(next)) continue;
        const double here = brick.middle(at), there = middleAt(next);
        const double trueHere = 2.0 * field_.magnitudeAt(v) + 1,
                     trueThere = 2.0 * field_.magnitudeAt(next) + 1;
        most = std::max(most, std::abs(here / (here + there) - trueHere / (trueHere + trueThere)));
      }
    });
    return most;
  }

 private:
  [[nodiscard]] uint32_t middleAt(const Coordinates<D>& v) const {
    Coordinates<D> brick;
    std::size_t at = 0;
    for (int a = D - 1; a >= 0; --a) {
      brick[a] = v[a] / kBrickSide;
      at = at * kBrickSide + static_cast<std::size_t>(v[a] % kBrickSide);
    }
    return theirs_.scalars.at(field_.table.index(brick)).middle(at);
  }

  template <class Code>
  void pass(Code code) {
    const auto bytes = coded(signs_, field_, [&](auto& exchange) { code(exchange, mine_); });
    ASSERT_TRUE(decoded<D>(bytes, [&](auto& exchange) { code(exchange, theirs_); }));
    ASSERT_TRUE(equal(mine_, theirs_));
  }

  WholeField<D> field_;
  Signs<D> signs_;
  Side<D> mine_, theirs_;
};

template <int D>
typename MagnitudeCoder<D>::Allowed alike(uint32_t allowed) {
  typename MagnitudeCoder<D>::Allowed all;
  all.fill(allowed);
  return all;
}

template <class Dimension>
class GeometryCoderTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(GeometryCoderTest, Dimensions);

template <int D>
Coordinates<D> box() {
  Coordinates<D> last;
  for (int a = 0; a < D; ++a) last[a] = 15 + 2 * a;
  return last;
}

TYPED_TEST(GeometryCoderTest, intervalsHoldTheTruthAfterEachPass) {
  constexpr int D = TypeParam::value;
  for (const auto& field : wholeFields<D>()) {
    for (const int exponentRange : {0, 3, 30}) {
      SCOPED_TRACE(field.name + ", exponentRange " + std::to_string(exponentRange));
      Coding<D> coding(box<D>(), field.value);
      for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
        coding.exponents(members, exponentRange);
        coding.expectActualInside(members);
      }
      for (uint32_t allowed : {8000u, 1000u}) {
        for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
          coding.magnitudePass(members, alike<D>(allowed), allowed == 8000 ? 2 : 30,
                               allowed == 1000);
          coding.expectActualInside(members);
        }
      }
    }
  }
}

TYPED_TEST(GeometryCoderTest, crossingsOfASmoothFieldKeepTheBound) {
  constexpr int D = TypeParam::value;
  Coding<D> coding(box<D>(), wholeFields<D>()[0].value);
  coding.exponents(Members::AxisEnds, 3);
  for (uint32_t allowed : {13000u, 3300u, 650u}) {
    coding.magnitudePass(Members::AxisEnds, alike<D>(allowed), 30, false);
    // A quarter more: what moves a crossing is judged to first order.
    EXPECT_LE(coding.furthest(), allowed / 65536.0 * 1.25);
  }
}

TYPED_TEST(GeometryCoderTest, whereNothingMayMoveAllIsTold) {
  constexpr int D = TypeParam::value;
  for (const auto& field : wholeFields<D>()) {
    SCOPED_TRACE(field.name);
    Coding<D> coding(box<D>(), field.value);
    auto nothing = alike<D>(0);
    nothing.back() = 1;  // diagonals count
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
      coding.exponents(members, 3);
      coding.magnitudePass(members, nothing, 30, false);
      coding.expectActualInside(members);
    }
    EXPECT_LE(coding.furthest(), 0x1p-18);
    if (field.name == "large" || field.name == "all scales")
      continue;  // more bits than a single-precision vertex has
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
      coding.forMembers(members, [&](const Coordinates<D>& v, const auto& brick, std::size_t at) {
        EXPECT_EQ(brick.width(at), 0) << testing::PrintToString(v);
      });
    }
  }
}

TYPED_TEST(GeometryCoderTest, theSteepestGradientThatCanBeTold) {
  constexpr int D = TypeParam::value;
  for (const auto& field : wholeFields<D>()) {
    SCOPED_TRACE(field.name);
    Coding<D> coding(box<D>(), field.value);
    coding.steepen(4 * 31 + 3);
    coding.exponents(Members::AxisEnds, 0);
    coding.magnitudePass(Members::AxisEnds, alike<D>(650), 30, false);
    coding.expectActualInside(Members::AxisEnds);
  }
}

TYPED_TEST(GeometryCoderTest, randomAnswersAreAlwaysSomeScalars) {
  constexpr int D = TypeParam::value;
  for (uint64_t seed = 0; seed < 24; ++seed) {
    const double rate = std::array{0.5, 0.05, 0.98, 1.0}[seed % 4];
    const int exponentRange = static_cast<int>(seed / 4 % 3) * 4;
    const auto signs =
        DenseSigns<D>(Lattice<D>(box<D>(), 1), signFields<D>(box<D>())[seed % 6].positive).bricks();
    Side<D> mine(signs), theirs(signs);
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
      auto exponents = [&](auto& exchange, Side<D>& side) {
        side.exponents.code(exchange, signs, side.scalars, members, exponentRange, side.active);
      };
      auto magnitudePass = [&](auto& exchange, Side<D>& side) {
        side.magnitudes.code(
            exchange, signs, side.scalars,
            {members, alike<D>(static_cast<uint32_t>(seed) * 100), 30, seed % 2 == 0}, side.active);
      };
      const auto first = thrown<D>(seed, rate, [&](auto& exchange) { exponents(exchange, mine); });
      ASSERT_TRUE(decoded<D>(first, [&](auto& exchange) { exponents(exchange, theirs); }));
      ASSERT_TRUE(equal(mine, theirs)) << "seed " << seed;
      const auto second =
          thrown<D>(seed, rate, [&](auto& exchange) { magnitudePass(exchange, mine); });
      ASSERT_TRUE(decoded<D>(second, [&](auto& exchange) { magnitudePass(exchange, theirs); }));
      ASSERT_TRUE(equal(mine, theirs)) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace isostar
