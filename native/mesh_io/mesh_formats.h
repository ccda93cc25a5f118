#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "files/output_file.h"
#include "isostar/isostar.h"

// A writer and a reader for each format, chosen by readMesh() and writeMesh(). Readers get the
// whole file; `path` is for error messages.
namespace isostar::native {

void writePly(const Mesh&, OutputFile&);
void writeObj(const Mesh&, OutputFile&);
void writeStl(const Mesh&, OutputFile&);
void writeGlb(const Mesh&, OutputFile&);

Mesh readPly(std::span<const std::byte>, const std::string& path);
Mesh readObj(std::span<const std::byte>, const std::string& path);
Mesh readStl(std::span<const std::byte>, const std::string& path);
Mesh readGlb(std::span<const std::byte>, const std::string& path);

}  // namespace isostar::native
