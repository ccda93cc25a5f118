#pragma once

#include <functional>
#include <string>

#include "volume/loaded_volume.h"

namespace isostar::native {

/// Reads a volume in a child process. The libraries for foreign formats assert, crash and print on damaged files, and a
/// stranger's file must not take the command down: a child that dies becomes a Failure naming `path`, and what it
/// prints is not shown.
LoadedVolume readInChild(const std::string& path, const std::function<LoadedVolume()>& read);

}  // namespace isostar::native
