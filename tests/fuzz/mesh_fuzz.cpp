// Arbitrary bytes as a mesh of the format ISOSTAR_EXTENSION: what is read is valid.
#include <cmath>

#include "files/failure.h"
#include "fuzz_file.h"
#include "fuzz_input.h"
#include "mesh_io/mesh_file.h"

using namespace isostar;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  static const FuzzFile file(ISOSTAR_EXTENSION);
  file.write(data, size);
  try {
    const Mesh mesh = native::readMesh(file.path());
    demand(mesh.positions.size() % 3 == 0 && mesh.indices.size() % 3 == 0);
    for (const float coordinate : mesh.positions) demand(std::isfinite(coordinate));
    for (const uint32_t vertex : mesh.indices) demand(vertex < mesh.positions.size() / 3);
  } catch (const native::Failure&) {
    // The only exception that may leave a reader which runs in no child process.
  }
  return 0;
}
