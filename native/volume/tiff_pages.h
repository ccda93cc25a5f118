#pragma once

#include <string>

namespace isostar::native {

/// Fails with one line where the list of a TIFF's pages leads out of the file, as libtiff takes the
/// pages before for all, and where its pages differ in size, as ITK takes each for one like the
/// first.
void requireEqualPages(const std::string& path);

}  // namespace isostar::native
