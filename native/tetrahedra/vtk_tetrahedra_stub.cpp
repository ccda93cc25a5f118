// Replaces vtk_tetrahedra.cpp in builds without VTK.
#include "files/failure.h"
#include "tetrahedra/tetrahedra_reader.h"

namespace isostar::native {

TetrahedralMesh readVtkTetrahedra(const std::string& path, const std::optional<std::string>&) {
  throw Failure(path, "this build of isostar reads no VTK files (it was built without VTK)");
}

}  // namespace isostar::native
