// Arbitrary headers that name other files. The files are looked up, not read.
#include "files/failure.h"
#include "fuzz_file.h"
#include "fuzz_input.h"
#include "volume/named_files.h"

using namespace isostar;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  static const FuzzFile nrrd(".nhdr"), meta(".mhd");
  for (const FuzzFile* file : {&nrrd, &meta}) {
    file->write(data, size);
    try {
      native::requireRegularFiles(file->path());
    } catch (const native::Failure&) {
      // The only exception that may leave the command line's own process.
    }
  }
  return 0;
}
