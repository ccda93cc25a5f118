#include "coding/geometry/displacement_coder.h"

#include <gtest/gtest.h>

#include "grid/refined_signs.h"
#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

/// Displacements in steps of a pass, by brick index and block.
struct ScatteredSteps : NoScalars {
  [[nodiscard]] int displacement(std::size_t brickIndex, std::size_t block) const {
    const std::size_t n = brickIndex * 131 + block * 17;
    return n % 3 == 0 ? static_cast<int>(n % 9) - 4 : 0;
  }
};

template <int D>
void expectDecoded(const Coordinates<D>& box) {
  const Lattice<D> lattice(box, 1);
  for (const auto& field : signFields<D>(box)) {
    const auto signs = DenseSigns<D>(lattice, field.positive).bricks();
    const auto active = activeBricks(signs);
    DisplacementCoder<D> encoder, decoder;
    Displacements<D> expected(active.size()), found(active.size());
    for (const DisplacementPass& pass :
         {DisplacementPass{3, 20}, {2, 12}, {1, 12}, {1, 3}, {2, 1}}) {
      const auto bytes = coded<D>(signs, ScatteredSteps(), [&](auto& exchange) {
        encoder.code(exchange, signs, expected, pass, active);
      });
      RangeDecoder coder(bytes);
      DecoderExchange<D> exchange(coder, 8, UINT64_MAX);
      decoder.code(exchange, signs, found, pass, active);
      ASSERT_FALSE(exchange.exhausted()) << field.name;
      for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex)
        ASSERT_EQ(expected.at(brickIndex), found.at(brickIndex)) << field.name;
    }
  }
}

TEST(DisplacementCoder, decodesWhatWasEncoded) {
  expectDecoded<2>({40, 23});
  expectDecoded<3>({20, 17, 9});
  expectDecoded<4>({9, 6, 10, 8});
}

TEST(DisplacementCoder, stopsWhereTheBytesEnd) {
  const auto signs =
      DenseSigns<3>(Lattice<3>({30, 30, 30}, 1), signFields<3>({30, 30, 30}).front().positive)
          .bricks();
  const auto active = activeBricks(signs);
  DisplacementCoder<3> coder;
  Displacements<3> displacements(active.size());
  RangeDecoder noBytes({});
  DecoderExchange<3> exchange(noBytes, 0, UINT64_MAX);
  coder.code(exchange, signs, displacements, {1, 1}, active);
  EXPECT_TRUE(exchange.exhausted());
}

}  // namespace
}  // namespace isostar
