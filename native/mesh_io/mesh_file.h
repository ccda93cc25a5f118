#pragma once

#include <string>

#include "isostar/isostar.h"

namespace isostar::native {

/// ".ply .obj .stl .glb": whether writeMesh() knows the extension, and whether readMesh() does (all but .glb).
bool canWriteMesh(const std::string& path);
bool canReadMesh(const std::string& path);

/// The file appears whole or not at all. Normals are written where the mesh has them and the format keeps them.
void writeMesh(const Mesh&, const std::string& path);

/// Positions and triangles; polygons become fans, STL's corners at equal places one vertex. Every index is in range and
/// every coordinate finite, or it fails with one line.
Mesh readMesh(const std::string& path);

}  // namespace isostar::native
