#include "coding/signs/keep_coder.h"

#include <gtest/gtest.h>

#include "grid/refined_signs.h"
#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

/// The centres that are absent after coding, brick by brick.
template <int D, class Exchange>
Signs<D> absentAfter(Exchange& exchange, const Signs<D>& signs) {
  KeepCoder<D> coder;
  NewVertexRows<D> rows;
  Signs<D> absent(signs.lattice());
  for (std::size_t brickIndex = 0; brickIndex < signs.table().total(); ++brickIndex) {
    rows.enter(signs, &absent, brickIndex, D);
    coder.code(exchange, brickIndex, rows);
    for (int i = 0; i < rows.openCount(); ++i) {
      const auto& row = rows.open(i);
      EXPECT_EQ(row.open & row.absent, 0) << "an absent vertex has no sign to code";
      if (row.absent != 0) absent.writable(brickIndex).rows[row.brick] = row.absent;
    }
  }
  return absent;
}

template <int D>
void expectDecoded(const Coordinates<D>& box) {
  const Lattice<D> lattice(box, 1);
  constexpr unsigned kAll = (1u << D) - 1;
  for (const auto& field : signFields<D>(box)) {
    SCOPED_TRACE(field.name);
    const auto signs = refined(DenseSigns<D>(Lattice<D>(box, 2), field.positive).bricks());
    const auto kept = DenseSigns<D>(lattice, [&](const auto& v) {
                        return lattice.newAxes(v) == kAll && scrambled<D>(v, 4) % 3 != 0;
                      }).bricks();
    Signs<D> encoded, found;
    const auto bytes = coded(signs, NoScalars(), [&](auto& exchange) {
      exchange.setKept(kept);
      encoded = absentAfter(exchange, signs);
    });
    EXPECT_TRUE(decoded<D>(bytes, [&](auto& exchange) { found = absentAfter(exchange, signs); }));
    EXPECT_EQ(DenseSigns<D>(found), DenseSigns<D>(encoded));
    NewVertexRows<D> rows;
    for (std::size_t brickIndex = 0; brickIndex < signs.table().total(); ++brickIndex) {
      rows.enter(signs, nullptr, brickIndex, D);
      for (int i = 0; i < rows.openCount(); ++i) {
        const auto& row = rows.open(i);
        EXPECT_EQ(found.brickAt(brickIndex).rows[row.brick] & row.open,
                  kept.brickAt(brickIndex).rows[row.brick] & row.open);
      }
    }
  }
}

TEST(KeepCoder, decodesTheCellsThatAreKept) {
  expectDecoded<2>({33, 17});
  expectDecoded<3>({17, 9, 16});
}

}  // namespace
}  // namespace isostar
