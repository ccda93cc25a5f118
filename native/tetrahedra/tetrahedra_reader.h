#pragma once

#include <optional>
#include <string>

#include "tetrahedra/tetrahedral_mesh.h"

namespace isostar::native {

/// Whether the file is .vtu, or a legacy .vtk that holds an unstructured grid.
bool isTetrahedral(const std::string& path);

/// The tetrahedra of an unstructured grid and the named scalar at its points; without a name, the
/// active scalar of the file or else the first one. Corners are in range; nothing else is
/// validated. Other cells are dropped with a remark that counts them. Throws a Failure if the file
/// is damaged or has no tetrahedra, no scalars, or none of that name.
TetrahedralMesh readVtkTetrahedra(const std::string& path,
                                  const std::optional<std::string>& scalar);

/// The same in a child process, and repaired by repair().
TetrahedralMesh readTetrahedra(const std::string& path, const std::optional<std::string>& scalar);

}  // namespace isostar::native
