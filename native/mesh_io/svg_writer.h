#pragma once

#include <string>

#include "isostar/isostar.h"

namespace isostar::native {

/// Draws an image's contours, with the positive side lightly filled, in a view from the first
/// sample to the last; y grows downwards, as in the image. The file is written completely or not at
/// all.
void writeSvg(const Contours&, const StreamInfo&, Frame, const std::string& path);

}  // namespace isostar::native
