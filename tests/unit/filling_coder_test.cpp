#include "coding/signs/filling_coder.h"

#include <gtest/gtest.h>

#include "grid/refined_signs.h"
#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

template <int D, class Exchange>
void fill(Exchange& exchange, Signs<D>& signs, const Signs<D>& absent) {
  FillingCoder<D> coder;
  for (int newAxisCount = D; newAxisCount > 0; --newAxisCount)
    coder.code(exchange, signs, newAxisCount, absent);
}

/// Random decisions give a field that fits the coarser level. Encoded anew, it is decoded the same.
template <int D>
void expectDecoded(const Coordinates<D>& box) {
  const Lattice<D> lattice(box, 1);
  for (const auto& field : signFields<D>(box)) {
    SCOPED_TRACE(field.name);
    const auto coarse = refined(DenseSigns<D>(Lattice<D>(box, 2), field.positive).bricks());
    const DenseSigns<D> isAbsent(lattice, [&](const auto& v) {
      return lattice.newAxes(v) != 0 && scrambled<D>(v, 6) % 4 != 0;
    });
    const auto absent = isAbsent.bricks();
    for (uint64_t seed = 0; seed < 3; ++seed) {
      Signs<D> actual = coarse, encoded = coarse, found = coarse;
      (void)randomlyCoded<D>(seed, 0.5, [&](auto& exchange) { fill(exchange, actual, absent); });
      const auto bytes =
          coded(actual, NoScalars(), [&](auto& exchange) { fill(exchange, encoded, absent); });
      EXPECT_TRUE(decoded<D>(bytes, [&](auto& exchange) { fill(exchange, found, absent); }));
      EXPECT_EQ(DenseSigns<D>(encoded), DenseSigns<D>(actual));
      EXPECT_EQ(DenseSigns<D>(found), DenseSigns<D>(actual));
      forVertices(lattice, [&](const Coordinates<D>& v) {
        EXPECT_TRUE(isAbsent.at(v) || found.at(v) == coarse.at(v)) << "only absent vertices change";
      });
    }
  }
}

TEST(FillingCoder, decodesTheSignsOfAbsentVertices) {
  expectDecoded<2>({33, 17});
  expectDecoded<3>({17, 9, 16});
}

TEST(FillingCoder, codesNothingWhereNoVertexIsAbsent) {
  const Coordinates<3> box{17, 9, 16};
  const auto signs =
      refined(DenseSigns<3>(Lattice<3>(box, 2), signFields<3>(box)[0].positive).bricks());
  auto filled = signs;
  const Signs<3> none(signs.lattice());
  EXPECT_TRUE(
      coded(signs, NoScalars(), [&](auto& exchange) { fill(exchange, filled, none); }).empty());
  EXPECT_EQ(DenseSigns<3>(filled), DenseSigns<3>(signs));
}

}  // namespace
}  // namespace isostar
