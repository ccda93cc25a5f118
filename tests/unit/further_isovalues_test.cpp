#include "coding/isovalues/further_isovalues.h"

#include <gtest/gtest.h>

#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

/// Iso steps at the vertices; vertices at or above the isovalue in work are positive.
template <int D>
struct IsoStepField {
  using Value = std::function<int32_t(const Coordinates<D>&)>;

  [[nodiscard]] uint32_t magnitude(std::size_t brickIndex, std::size_t r, int x) const {
    Coordinates<D> v = table.brick(brickIndex);
    for (int32_t& c : v) c *= kBrickSide;
    v[0] += x;
    for (int a = 1; a < D; ++a, r /= kBrickSide) v[a] += static_cast<int32_t>(r % kBrickSide);
    const int32_t away = value(v) - isoStep;
    return static_cast<uint32_t>(away >= 0 ? away : -1 - away);
  }
  [[nodiscard]] int gradient(std::size_t) const { return 24; }
  [[nodiscard]] bool selected(std::size_t brickIndex) const { return brickIndex % 2 == 0; }

  BrickTable<D> table;
  Value value;
  int32_t isoStep = 0;
};

/// A first isovalue that is known in part, and further ones coded on top of it.
template <int D>
class RoundTrip {
 public:
  RoundTrip(const Coordinates<D>& box, typename IsoStepField<D>::Value value)
      : lattice_(box, 1),
        field_{BrickTable<D>(lattice_), std::move(value)},
        first_(signsAt(0)),
        scalars_(first_.table().total()) {
    // Of the first isovalue only the exponents in its tube are known.
    ExponentCoder<D> exponents;
    const auto active = activeBricks(first_);
    (void)coded<D>(first_, field_, [&](auto& exchange) {
      exponents.code(exchange, first_, scalars_, Members::AxisEnds, 2, active);
    });
  }

  void add(int32_t isoStep) {
    field_.isoStep = isoStep;
    const Signs<D> actual = signsAt(isoStep);
    pass(actual, [&](auto& exchange, FurtherIsovalues<D>& side) {
      side.signs(exchange, {0.0, first_, scalars_}, isoStep, isoStep, 0);
    });
    expectSigns(actual);
    pass(actual, [&](auto& exchange, FurtherIsovalues<D>& side) {
      side.exponents(exchange, Members::AxisEnds, 2);
    });
    typename FarEnds<D>::Allowed allowed;
    allowed.fill(3000);
    for (const bool selective : {true, false}) {
      pass(actual, [&](auto& exchange, FurtherIsovalues<D>& side) {
        side.magnitudes(exchange, {Members::AxisEnds, allowed, 30, selective});
      });
    }
    expectScalars();
  }

 private:
  [[nodiscard]] Signs<D> signsAt(int32_t isoStep) const {
    return DenseSigns<D>(lattice_, [&](const auto& v) { return field_.value(v) >= isoStep; })
        .bricks();
  }
  template <class Code>
  void pass(const Signs<D>& actual, Code code) {
    const auto bytes = coded<D>(actual, field_, [&](auto& exchange) { code(exchange, encoder_); });
    EXPECT_TRUE(decoded<D>(bytes, [&](auto& exchange) { code(exchange, decoder_); }));
  }
  void expectSigns(const Signs<D>& actual) const {
    const auto& found = decoder_.surfaces().back().signs;
    Coordinates<D> v{};
    for (uint64_t i = 0; i < lattice_.vertices(); ++i) {
      ASSERT_EQ(found.at(v), actual.at(v)) << testing::PrintToString(v);
      for (int a = 0; a < D && ++v[a] > lattice_.last[a]; ++a) v[a] = 0;
    }
  }
  /// Each vertex of the tube has a scalar of its sign, the same on both sides.
  void expectScalars() const {
    const FurtherSurface<D>&found = decoder_.surfaces().back(),
          &expected = encoder_.surfaces().back();
    Tube<D> tube;
    for (std::size_t brickIndex = 0; brickIndex < found.active.size(); ++brickIndex) {
      ASSERT_EQ(found.scalars.has(brickIndex), expected.scalars.has(brickIndex));
      ASSERT_EQ(found.scalars.at(brickIndex).value, expected.scalars.at(brickIndex).value);
      if (found.active[brickIndex] == 0) continue;
      tube.enter(found.signs, brickIndex, Members::AxisEnds);
      tube.forEach([&](int row, std::size_t r, int x) {
        const int32_t value =
            found.scalars.at(brickIndex).value[r * kBrickSide + static_cast<std::size_t>(x)];
        ASSERT_NE(value, Scalars<D>::kUnknown);
        ASSERT_EQ(value > 0, tube.positive(row, x));
      });
    }
  }

  Lattice<D> lattice_;
  IsoStepField<D> field_;
  Signs<D> first_;
  Scalars<D> scalars_;
  FurtherIsovalues<D> encoder_, decoder_;
};

template <int D>
std::vector<typename IsoStepField<D>::Value> isoStepFields() {
  return {
      [](const auto& v) {
        int32_t squares = 0;
        for (int32_t x : v) squares += (x - 8) * (x - 8);
        return 400 - 10 * squares;
      },
      [](const auto& v) { return static_cast<int32_t>(scrambled<D>(v, 7) % 2001) - 1000; },
      [](const auto& v) { return v[0] * 40 - 300 + static_cast<int32_t>(scrambled<D>(v, 5) % 60); },
      [](const auto&) { return -5; }};
}

template <int D>
void expectDecoded(const Coordinates<D>& box) {
  for (const auto& field : isoStepFields<D>()) {
    RoundTrip<D> roundTrip(box, field);
    for (const int32_t isoStep : {10, 30, -25, 20, 0, 2000, -2000, 150}) roundTrip.add(isoStep);
  }
}

TEST(FurtherIsovalues, decodeWhatWasEncodedIn2D) {
  for (const auto& box : {Coordinates<2>{16, 16}, {30, 7}, {1, 1}, {0, 5}, {100, 40}})
    expectDecoded<2>(box);
}
TEST(FurtherIsovalues, decodeWhatWasEncodedIn3D) {
  for (const auto& box : {Coordinates<3>{16, 16, 16}, {30, 7, 9}, {1, 1, 1}, {40, 2, 25}})
    expectDecoded<3>(box);
}

TEST(FurtherIsovalues, decodeAnyDecisions) {
  const Lattice<3> lattice({20, 17, 18}, 1);
  const Signs<3> first =
      DenseSigns<3>(lattice, [](const auto& v) { return v[0] + v[1] > 15; }).bricks();
  const Scalars<3> none(first.table().total());
  for (uint64_t seed = 0; seed < 8; ++seed) {
    FurtherIsovalues<3> encoder, decoder;
    for (const int32_t isoStep : {5, -5, 2, (1 << 29) - 1}) {
      const auto run = [&](auto code) {
        const auto bytes = randomlyCoded<3>(seed, seed % 2 == 0 ? 1 : 0.3,
                                            [&](auto& exchange) { code(exchange, encoder); });
        EXPECT_TRUE(decoded<3>(bytes, [&](auto& exchange) { code(exchange, decoder); }));
      };
      run([&](auto& exchange, FurtherIsovalues<3>& side) {
        side.signs(exchange, {0.0, first, none}, isoStep, isoStep, 1);
      });
      run([&](auto& exchange, FurtherIsovalues<3>& side) {
        side.exponents(exchange, Members::AxisEnds, 3);
      });
      run([&](auto& exchange, FurtherIsovalues<3>& side) {
        side.magnitudes(exchange, {Members::AxisEnds, {1, 1, 1, 1, 1, 1, 1, 1}, 30, false});
      });
      const auto &a = encoder.surfaces().back(), &b = decoder.surfaces().back();
      for (std::size_t brickIndex = 0; brickIndex < a.active.size(); ++brickIndex) {
        ASSERT_EQ(a.signs.brickAt(brickIndex), b.signs.brickAt(brickIndex));
        ASSERT_EQ(a.scalars.at(brickIndex).value, b.scalars.at(brickIndex).value);
      }
    }
  }
}

}  // namespace
}  // namespace isostar
