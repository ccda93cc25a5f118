#pragma once

#include <string>

#include "isostar/isostar.h"

namespace isostar::native {

/// Whether the extension is one that readMesh() and writeMesh() support: .ply .obj .stl .glb.
bool isMeshFile(const std::string& path);

/// Whether a mesh file of this extension has normals of vertices.
bool storesNormals(const std::string& path);

/// The file is written completely or not at all. Normals are written if the mesh has them and the
/// format stores them.
void writeMesh(const Mesh&, const std::string& path);

/// Positions and triangles. Polygons become fans; STL's corners at equal positions become one
/// vertex; the nodes of a GLB are transformed to the scene's coordinates. Throws a Failure if an
/// index is out of range or a coordinate is not finite.
Mesh readMesh(const std::string& path);

}  // namespace isostar::native
