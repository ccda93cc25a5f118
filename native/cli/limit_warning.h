#pragma once

#include <string>

#include "isostar/isostar.h"

namespace isostar::native {

/// What of the stream is over the limits, by its header: "... vertices are over ...". Empty if
/// nothing is.
std::string overLimits(const StreamInfo&, const Limits&);

}  // namespace isostar::native
