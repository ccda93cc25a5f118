#pragma once

#include <functional>
#include <string>

#include "volume/loaded_volume.h"

namespace isostar::native {

/// Reads a volume in a child process, for the reasons of runInChild(): a reader that dies becomes a
/// Failure naming `path`.
LoadedVolume readInChild(const std::string& path, const std::function<LoadedVolume()>& read);

}  // namespace isostar::native
