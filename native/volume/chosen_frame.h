#pragma once

#include <string>

#include "volume/choices.h"
#include "volume/loaded_volume.h"

namespace isostar::native {

/// Reduces a sequence to the chosen frame; without a choice it stays whole, with a remark. Throws a
/// Failure if there is no such frame.
void takeFrame(LoadedVolume&, const std::string& path, const Choices&);

}  // namespace isostar::native
