#pragma once

#include <optional>
#include <string>

#include "tetrahedra/tetrahedral_mesh.h"

namespace isostar::native {

/// Whether the file is .vtu, or a legacy .vtk that holds an unstructured grid.
bool isTetrahedral(const std::string& path);

/// The tetrahedra of an unstructured grid and the scalar of that name at its points; without a name
/// the one the file marks, else the first. Corners are in range; nothing else has been looked at.
/// Other cells are left out with a remark that counts them. Fails with one line where the file is
/// damaged, has no tetrahedra, no scalars, or none of that name.
TetrahedralMesh readVtkTetrahedra(const std::string& path,
                                  const std::optional<std::string>& scalar);

/// The same in a child process, and mended: see mend().
TetrahedralMesh readTetrahedra(const std::string& path, const std::optional<std::string>& scalar);

}  // namespace isostar::native
