// Stands in for vtk_tetrahedra.cpp in builds that found no VTK.
#include "files/failure.h"
#include "tetrahedra/formats.h"

namespace isostar::native {

TetrahedralMesh readVtkTetrahedra(const std::string& path, const std::optional<std::string>&) {
  throw Failure(path,
                "this build of isostar reads no VTK files (VTK was not found when it was built)");
}

}  // namespace isostar::native
