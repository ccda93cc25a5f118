#pragma once

#include <string>

class vtkAlgorithm;

namespace isostar::native {

/// Runs a VTK reader; false where it met any error. VTK goes on after most of them, and misses
/// samples with no more than a warning in its window.
bool updateQuietly(vtkAlgorithm&);

/// An XML file with entities can grow without bound while it is parsed; no VTK file needs them.
/// Fails with one line.
void refuseEntities(const std::string& path);

}  // namespace isostar::native
