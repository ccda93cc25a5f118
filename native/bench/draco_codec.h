#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "isostar/isostar.h"

namespace isostar::bench {

/// As `draco_encoder -cl LEVEL -qp BITS` does with positions and triangles.
std::vector<std::byte> encodeDraco(const Mesh&, int level, int bits);

/// Draco's own work only, as its users have it; tells the number of faces so that no compiler
/// leaves it out.
size_t decodeDraco(std::span<const std::byte>);

/// The same with the surface taken out, for measuring it.
Mesh meshOfDraco(std::span<const std::byte>);

}  // namespace isostar::bench
