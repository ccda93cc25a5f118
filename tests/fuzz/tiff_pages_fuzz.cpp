// Arbitrary bytes as the list of a TIFF's pages.
#include "files/failure.h"
#include "fuzz_file.h"
#include "fuzz_input.h"
#include "volume/tiff_pages.h"

using namespace isostar;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  static const FuzzFile file(".tif");
  file.write(data, size);
  try {
    native::requireEqualPages(file.path());
  } catch (const native::Failure&) {
    // A list that is cut, cyclic or of different pages.
  }
  return 0;
}
