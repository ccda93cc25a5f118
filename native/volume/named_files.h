#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace isostar::native {

/// The regular files in a folder whose names do not begin with a dot, sorted.
std::vector<std::string> filesIn(const std::string& folder);

/// All files that are read with an input: itself, or those of a folder, and those that its header
/// names (NRRD `data file:`, MetaImage `ElementDataFile`, the other file of a NIfTI pair). Only
/// those that exist.
std::vector<std::string> filesReadWith(const std::string& path);

/// Throws a Failure if the header names a device or a pipe.
void requireRegularFiles(const std::string& path);

/// The length of all files that are read with an input.
uint64_t bytesReadWith(const std::string& path);

}  // namespace isostar::native
