#include "coding/isovalues/further_isovalues.h"

#include <gtest/gtest.h>

#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

TEST(Interval, isWhatAMagnitudeSaysSeenFromALevel) {
  Scalars<2>::Brick brick{};
  brick.set(0, true, 8, 3);
  brick.set(1, false, 8, 3);
  const Interval above = Interval::of(brick.value[0], 100), below = Interval::of(brick.value[1], 100);
  EXPECT_EQ(above.low, 108);
  EXPECT_EQ(above.high, 116);
  EXPECT_EQ(below.low, 84);   // -1 is the first negative level: magnitudes 8 … 15 are -9 … -16
  EXPECT_EQ(below.high, 92);
  EXPECT_EQ(above.value(100), brick.value[0]);
  EXPECT_EQ(below.value(100), brick.value[1]);
}

TEST(Interval, isNeverNothing) {
  for (int32_t low = -3; low < 3; ++low) {
    for (int32_t high = low + 1; high < 4; ++high) {
      for (int32_t level = -6; level < 6; ++level) {
        for (const bool side : {false, true}) {
          const Interval cut = Interval{low, high}.cut(level, side);
          EXPECT_LT(cut.low, cut.high);
          if (side) EXPECT_GE(cut.low, level);
          else EXPECT_LE(cut.high, level);
        }
      }
    }
  }
}

/// Levels at the vertices; those above the level in work are positive.
template <int D>
struct LevelField {
  using Value = std::function<int32_t(const Coordinates<D>&)>;

  [[nodiscard]] uint32_t magnitude(std::size_t place, std::size_t r, int x) const {
    Coordinates<D> v = table.brick(place);
    for (int32_t& c : v) c *= kBrickSide;
    v[0] += x;
    for (int a = 1; a < D; ++a, r /= kBrickSide) v[a] += static_cast<int32_t>(r % kBrickSide);
    const int32_t away = value(v) - level;
    return static_cast<uint32_t>(away >= 0 ? away : -1 - away);
  }
  [[nodiscard]] int gradient(std::size_t) const { return 24; }
  [[nodiscard]] bool selected(std::size_t place) const { return place % 2 == 0; }

  BrickTable<D> table;
  Value value;
  int32_t level = 0;
};

/// A first isovalue that is known in part, and further ones told on top of it.
template <int D>
class Telling {
 public:
  Telling(const Coordinates<D>& box, typename LevelField<D>::Value value)
      : lattice_(box, 1), field_{BrickTable<D>(lattice_), std::move(value)}, first_(signsAt(0)), scalars_(first_.table().total()) {
    // Octaves of the first one's tube only.
    OctavesCoder<D> octaves;
    const auto active = activeBricks(first_);
    (void)told<D>(first_, field_, [&](auto& ask) { octaves.tell(ask, first_, scalars_, Members::AxisEnds, 2, active); });
  }

  void add(int32_t level) {
    field_.level = level;
    const Signs<D> truth = signsAt(level);
    pass(truth, [&](auto& ask, CloseBy<D>& side) { side.signs(ask, {0.0, first_, scalars_}, level, level, 0); });
    expectSigns(truth);
    pass(truth, [&](auto& ask, CloseBy<D>& side) { side.octaves(ask, Members::AxisEnds, 2); });
    typename FarEnds<D>::Allowed allowed;
    allowed.fill(3000);
    for (const bool selective : {true, false}) {
      pass(truth, [&](auto& ask, CloseBy<D>& side) { side.halvings(ask, {Members::AxisEnds, allowed, 30, selective}); });
    }
    expectScalars();
  }

 private:
  [[nodiscard]] Signs<D> signsAt(int32_t level) const {
    return DenseSigns<D>(lattice_, [&](const auto& v) { return field_.value(v) >= level; }).bricks();
  }
  template <class Tell>
  void pass(const Signs<D>& truth, Tell tell) {
    const auto bytes = told<D>(truth, field_, [&](auto& ask) { tell(ask, mine_); });
    EXPECT_TRUE(heard<D>(bytes, [&](auto& ask) { tell(ask, theirs_); }));
  }
  void expectSigns(const Signs<D>& truth) const {
    const auto& found = theirs_.surfaces().back().signs;
    Coordinates<D> v{};
    for (uint64_t i = 0; i < lattice_.vertices(); ++i) {
      ASSERT_EQ(found.at(v), truth.at(v)) << testing::PrintToString(v);
      for (int a = 0; a < D && ++v[a] > lattice_.last[a]; ++a) v[a] = 0;
    }
  }
  /// Each vertex of the tube has a scalar of its sign, the same on both sides.
  void expectScalars() const {
    const NearSurface<D>&found = theirs_.surfaces().back(), &expected = mine_.surfaces().back();
    Tube<D> tube;
    for (std::size_t place = 0; place < found.active.size(); ++place) {
      ASSERT_EQ(found.scalars.has(place), expected.scalars.has(place));
      ASSERT_EQ(found.scalars.at(place).value, expected.scalars.at(place).value);
      if (found.active[place] == 0) continue;
      tube.enter(found.signs, place, Members::AxisEnds);
      tube.forEach([&](int row, std::size_t r, int x) {
        const int32_t value = found.scalars.at(place).value[r * kBrickSide + static_cast<std::size_t>(x)];
        ASSERT_NE(value, Scalars<D>::kUnknown);
        ASSERT_EQ(value > 0, tube.positive(row, x));
      });
    }
  }

  Lattice<D> lattice_;
  LevelField<D> field_;
  Signs<D> first_;
  Scalars<D> scalars_;
  CloseBy<D> mine_, theirs_;
};

template <int D>
std::vector<typename LevelField<D>::Value> levelFields() {
  return {[](const auto& v) {
            int32_t squares = 0;
            for (int32_t x : v) squares += (x - 8) * (x - 8);
            return 400 - 10 * squares;
          },
          [](const auto& v) { return static_cast<int32_t>(scrambled<D>(v, 7) % 2001) - 1000; },
          [](const auto& v) { return v[0] * 40 - 300 + static_cast<int32_t>(scrambled<D>(v, 5) % 60); },
          [](const auto&) { return -5; }};
}

template <int D>
void expectHeard(const Coordinates<D>& box) {
  for (const auto& field : levelFields<D>()) {
    Telling<D> telling(box, field);
    for (const int32_t level : {10, 30, -25, 20, 0, 2000, -2000, 150}) telling.add(level);
  }
}

TEST(CloseBy, isHeardAsTold2D) {
  for (const auto& box : {Coordinates<2>{16, 16}, {30, 7}, {1, 1}, {0, 5}, {100, 40}}) expectHeard<2>(box);
}
TEST(CloseBy, isHeardAsTold3D) {
  for (const auto& box : {Coordinates<3>{16, 16, 16}, {30, 7, 9}, {1, 1, 1}, {40, 2, 25}}) expectHeard<3>(box);
}

TEST(CloseBy, anyAnswersAreAStream) {
  const Lattice<3> lattice({20, 17, 18}, 1);
  const Signs<3> first = DenseSigns<3>(lattice, [](const auto& v) { return v[0] + v[1] > 15; }).bricks();
  const Scalars<3> none(first.table().total());
  for (uint64_t seed = 0; seed < 8; ++seed) {
    CloseBy<3> dice, listener;
    for (const int32_t level : {5, -5, 2, (1 << 29) - 1}) {
      const auto run = [&](auto tell) {
        const auto bytes = thrown<3>(seed, seed % 2 == 0 ? 1 : 0.3, [&](auto& ask) { tell(ask, dice); });
        EXPECT_TRUE(heard<3>(bytes, [&](auto& ask) { tell(ask, listener); }));
      };
      run([&](auto& ask, CloseBy<3>& side) { side.signs(ask, {0.0, first, none}, level, level, 1); });
      run([&](auto& ask, CloseBy<3>& side) { side.octaves(ask, Members::AxisEnds, 3); });
      run([&](auto& ask, CloseBy<3>& side) { side.halvings(ask, {Members::AxisEnds, {1, 1, 1, 1, 1, 1, 1, 1}, 30, false}); });
      const auto &a = dice.surfaces().back(), &b = listener.surfaces().back();
      for (std::size_t place = 0; place < a.active.size(); ++place) {
        ASSERT_EQ(a.signs.brickAt(place), b.signs.brickAt(place));
        ASSERT_EQ(a.scalars.at(place).value, b.scalars.at(place).value);
      }
    }
  }
}

}  // namespace
}  // namespace isostar
