#pragma once

#include <string>

#include "isostar/isostar.h"

namespace isostar::native {

/// Draws an image's contours, the positive side lightly filled, in the frame from the first sample
/// to the last; larger y are further down, as in the image. The file appears whole or not at all.
void writeSvg(const Contours&, const StreamInfo&, Frame, const std::string& path);

}  // namespace isostar::native
