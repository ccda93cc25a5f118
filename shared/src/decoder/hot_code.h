// What takes the time of a page's decoder: compiled for speed, in hot_code.cpp, while all else is
// compiled for size.
#pragma once

#include "coding/chunk_state.h"
#include "coding/codec_state.h"
#include "container/crc.h"
#include "estimate/completion.h"

/// ISOSTAR_TEMPLATE: `extern template`, or `template` in the one file that has the code.
#ifndef ISOSTAR_TEMPLATE
#define ISOSTAR_TEMPLATE extern template
#endif

namespace isostar {

using Bricks = std::vector<uint8_t>;

ISOSTAR_TEMPLATE void RefinementCoder<3>::code(DecoderExchange<3>&, Signs<3>&, Signs<3>*,
                                               const Bricks*);
ISOSTAR_TEMPLATE void GeometryState<3>::codePass(DecoderExchange<3>&, const Signs<3>&,
                                                 const GeometryPass<3>&, SmoothingFilter, bool,
                                                 ExponentCoder<3>*);
ISOSTAR_TEMPLATE Signs<3> refined(const Signs<3>&);
ISOSTAR_TEMPLATE Bricks activeBricks(const Signs<3>&);
ISOSTAR_TEMPLATE void estimateMissing(const Signs<3>&, const Bricks&, Members, int, Scalars<3>&,
                                      const Hints<3>&, int);
ISOSTAR_TEMPLATE class Dequantization<3>;
ISOSTAR_TEMPLATE class BrickTable<3>;
ISOSTAR_TEMPLATE class Crc<uint16_t, 0x1021>;
ISOSTAR_TEMPLATE class Crc<uint32_t, 0x1EDC6F41>;

}  // namespace isostar
