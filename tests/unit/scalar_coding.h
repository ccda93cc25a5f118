// Runs the coders of exponents and magnitudes on one level, encoding and decoding.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "coding/geometry/exponent_coder.h"
#include "coding/geometry/magnitude_coder.h"
#include "grid/refined_signs.h"
#include "sign_fields.h"
#include "traversal.h"

namespace isostar {

/// Whole numbers at the vertices, positive above zero. 1 and 0 both have the magnitude 0.
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
struct NamedField {
  std::string name;
  typename WholeField<D>::Value value;
};

template <int D>
std::vector<NamedField<D>> wholeFields() {
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

/// The state of the encoder or of the decoder: scalars and coders.
template <int D>
struct ScalarSide {
  explicit ScalarSide(const Signs<D>& s)
      : signs(s), active(activeBricks(s)), scalars(active.size()) {}

  const Signs<D>& signs;
  std::vector<uint8_t> active;
  Scalars<D> scalars;
  ExponentCoder<D> exponents;
  MagnitudeCoder<D> magnitudes;
};

template <int D>
bool equal(const ScalarSide<D>& a, const ScalarSide<D>& b) {
  for (std::size_t brickIndex = 0; brickIndex < a.active.size(); ++brickIndex) {
    if (a.scalars.has(brickIndex) != b.scalars.has(brickIndex)) return false;
    if (a.scalars.at(brickIndex).value != b.scalars.at(brickIndex).value) return false;
  }
  return true;
}

/// A field that is encoded and decoded pass by pass.
template <int D>
class ScalarRoundTrip {
 public:
  ScalarRoundTrip(const Coordinates<D>& box, typename WholeField<D>::Value value)
      : field_(Lattice<D>(box, 1), std::move(value)),
        signs_(DenseSigns<D>(Lattice<D>(box, 1), [&](const auto& v) { return field_.value(v) > 0; })
                   .bricks()),
        encoder_(signs_),
        decoder_(signs_) {}

  void exponents(Members members, int exponentRange) {
    pass([=](auto& exchange, ScalarSide<D>& side) {
      side.exponents.code(exchange, side.signs, side.scalars, members, exponentRange, side.active);
    });
  }
  void magnitudePass(Members members, const typename MagnitudeCoder<D>::Allowed& allowed, int most,
                     bool selective) {
    pass([=](auto& exchange, ScalarSide<D>& side) {
      side.magnitudes.code(exchange, side.signs, side.scalars, {members, allowed, most, selective},
                           side.active);
    });
  }

  void steepen(int gradient) { field_.steepest = gradient; }

  /// Calls visit(vertex, brick, its number in it) for each vertex of a class.
  template <class Visit>
  void forMembers(Members members, Visit visit) const {
    Tube<D> tube;
    for (std::size_t brickIndex = 0; brickIndex < decoder_.active.size(); ++brickIndex) {
      if (decoder_.active[brickIndex] == 0) continue;
      tube.enter(signs_, brickIndex, members);
      tube.forEach([&](int, std::size_t r, int x) {
        visit(field_.vertex(brickIndex, r, x), decoder_.scalars.at(brickIndex),
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

  /// The largest distance of a crossing of an axis edge from its actual position, in parts of the
  /// edge.
  [[nodiscard]] double furthest() const {
    double most = 0;
    forMembers(Members::AxisEnds, [&](const Coordinates<D>& v, const auto& brick, std::size_t at) {
      for (int a = 0; a < D; ++a) {
        auto next = v;
        if (++next[a] > signs_.lattice().last[a] || signs_.at(v) == signs_.at(next)) continue;
        const double here = brick.middle(at), there = middleAt(next);
        const double actualHere = 2.0 * field_.magnitudeAt(v) + 1,
                     actualThere = 2.0 * field_.magnitudeAt(next) + 1;
        most = std::max(most,
                        std::abs(here / (here + there) - actualHere / (actualHere + actualThere)));
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
    return decoder_.scalars.at(field_.table.index(brick)).middle(at);
  }

  template <class Code>
  void pass(Code code) {
    const auto bytes = coded(signs_, field_, [&](auto& exchange) { code(exchange, encoder_); });
    ASSERT_TRUE(decoded<D>(bytes, [&](auto& exchange) { code(exchange, decoder_); }));
    ASSERT_TRUE(equal(encoder_, decoder_));
  }

  WholeField<D> field_;
  Signs<D> signs_;
  ScalarSide<D> encoder_, decoder_;
};

template <int D>
typename MagnitudeCoder<D>::Allowed sameOnAllEdges(uint32_t allowed) {
  typename MagnitudeCoder<D>::Allowed all;
  all.fill(allowed);
  return all;
}

template <int D>
Coordinates<D> scalarBox() {
  Coordinates<D> last;
  for (int a = 0; a < D; ++a) last[a] = 15 + 2 * a;
  return last;
}

}  // namespace isostar
