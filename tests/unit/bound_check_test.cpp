#include "encoder/core/bound_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid/tube.h"

namespace isostar {
namespace {

/// A ball whose scalars are coded with errors.
class ErroneousBall {
 public:
  ErroneousBall() : samples_(ball()), field(samples_, {40, 40, 40}, 0), signs(field.signs()) {
    header.quantizationStep = 1.0 / 256;
    active = activeBricks(signs);
    scalars = Scalars<3>(active.size());
    code(active, 600);
  }
  /// Codes the scalars of the marked bricks with errors of up to so many steps.
  void code(const std::vector<uint8_t>& marked, unsigned most) {
    Tube<3> tube;
    for (std::size_t brickIndex = 0; brickIndex < marked.size(); ++brickIndex) {
      if (marked[brickIndex] == 0) continue;
      tube.enter(signs, brickIndex, Members::AxisEnds);
      tube.forEach([&](int row, std::size_t r, int x) {
        scalars.writable(brickIndex)
            .set(r * kBrickSide + static_cast<std::size_t>(x), tube.positive(row, x),
                 field.magnitude(header, brickIndex, r, x) + random_() % (most + 1), 0);
      });
    }
  }

 private:
  static std::vector<float> ball() {
    std::vector<float> samples;
    for (int z = 0; z < 40; ++z) {
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x)
          samples.push_back(static_cast<float>(15.3 - std::hypot(x - 19, y - 20, z - 20.5)));
      }
    }
    return samples;
  }

  std::vector<float> samples_;
  std::mt19937 random_{1};

 public:
  GridField<3> field;
  Header header;
  Signs<3> signs;
  std::vector<uint8_t> active;
  Scalars<3> scalars;
};

TEST(BoundCheck, findsAgainWhatHasChanged) {
  constexpr double kBound = 0.3;
  const RunTasks inOrder;
  ErroneousBall ball;
  BoundCheck<3> check(ball.field, ball.header, inOrder);
  auto beyond = check.beyond(kBound, ball.signs, ball.scalars, ball.active);
  for (const unsigned most : {300u, 150u, 0u}) {
    ASSERT_FALSE(beyond.empty()) << most;
    EXPECT_GT(check.largest(), kBound);
    ball.code(beyond, most);
    beyond = check.beyond(kBound, ball.signs, ball.scalars, ball.active, beyond);
    BoundCheck<3> whole(ball.field, ball.header, inOrder);
    EXPECT_EQ(beyond, whole.beyond(kBound, ball.signs, ball.scalars, ball.active));
    EXPECT_EQ(check.largest(), whole.largest());
  }
  ball.code(ball.active, 0);
  EXPECT_TRUE(check.beyond(kBound, ball.signs, ball.scalars, ball.active).empty());
  EXPECT_LT(check.largest(), 0.05);
}

}  // namespace
}  // namespace isostar
