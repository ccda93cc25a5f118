#pragma once

#include <string>

namespace isostar::native {

/// Throws a Failure if the list of a TIFF's pages leads out of the file (libtiff would silently
/// drop the rest) or if the pages differ in size (ITK would read each with the size of the first).
void requireEqualPages(const std::string& path);

}  // namespace isostar::native
