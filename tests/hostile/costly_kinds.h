// Kinds of streams that cost a decoder much: a search starts with them, and tests decode them.
#pragma once

#include "costly_streams.h"

namespace isostar {

/// `side`: of the box of volumes; others have about as many samples.
[[nodiscard]] std::vector<CostlyStream> costlyKinds(int32_t side);

}  // namespace isostar
