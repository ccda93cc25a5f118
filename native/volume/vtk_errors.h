#pragma once

#include <string>

class vtkAlgorithm;

namespace isostar::native {

/// Runs a VTK reader; false after any error or warning. VTK continues after most errors, and
/// reports missing samples only as a warning.
bool updateQuietly(vtkAlgorithm&);

/// Throws a Failure on an XML file with entities: they can expand without bound while the file is
/// parsed, and no VTK file needs them.
void refuseEntities(const std::string& path);

}  // namespace isostar::native
