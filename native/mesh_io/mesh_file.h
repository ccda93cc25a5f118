#pragma once

#include <string>

#include "isostar/isostar.h"

namespace isostar::native {

/// Whether readMesh() and writeMesh() know the extension: .ply .obj .stl .glb.
bool isMeshFile(const std::string& path);

/// The file appears whole or not at all. Normals are written where the mesh has them and the format
/// keeps them.
void writeMesh(const Mesh&, const std::string& path);

/// Positions and triangles; polygons become fans, STL's corners at equal places one vertex,
/// GLB's nodes lie where the scene has them. Every index is in range and
/// every coordinate finite, or it fails with one line.
Mesh readMesh(const std::string& path);

}  // namespace isostar::native
