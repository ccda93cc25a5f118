#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/subject.h"

namespace isostar::bench {

std::vector<std::byte> encodeIsostar(const Subject&, double maxError);
/// With coarse simplices where they keep the bound and are smaller.
std::vector<std::byte> encodeIsostarAdaptive(const Subject&, double maxError);
/// Every surface along it has the components and handles of the last one.
std::vector<std::byte> encodeIsostarOfOneTopology(const Subject&, double maxError);
/// A further isovalue on top.
std::vector<std::byte> encodeIsostarWith(const Subject&, double near, double maxError);
std::vector<std::byte> encodeIsostarLossless(const Subject&);

/// A decoder that has made the most of a prefix; fails with one line where a prefix is anything but
/// short.
Decoder decodeIsostar(std::span<const std::byte> prefix);

/// Marching cubes' mesh of what it knows, in sample indices.
Mesh meshOf(const Decoder&, bool normals);

}  // namespace isostar::bench
