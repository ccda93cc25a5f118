#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "isostar/isostar.h"

namespace isostar::bench {

/// Encodes positions and triangles as `draco_encoder -cl LEVEL -qp BITS` does.
std::vector<std::byte> encodeDraco(const Mesh&, int level, int bits);

/// Decodes to Draco's own mesh, without conversion, to measure the time. Returns the number of
/// faces, so that the compiler cannot remove the call.
size_t decodeDraco(std::span<const std::byte>);

/// Decodes and converts to a Mesh, to measure distances.
Mesh meshOfDraco(std::span<const std::byte>);

}  // namespace isostar::bench
