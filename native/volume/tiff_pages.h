#pragma once

#include <string>

namespace isostar::native {

/// Fails with one line where the list of a TIFF's pages leads out of the file: libtiff takes the pages before for all.
void requireWholePageList(const std::string& path);

}  // namespace isostar::native
