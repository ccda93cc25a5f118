#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/subject.h"

namespace isostar::bench {

std::vector<std::byte> encodeIsostar(const Subject&, double maxError, const RunTasks& = {});
/// With chunks of this side; 0: one chunk.
std::vector<std::byte> encodeIsostarInChunks(const Subject&, double maxError, int side);
/// With coarse simplices if they keep the bound and make the stream smaller.
std::vector<std::byte> encodeIsostarAdaptive(const Subject&, double maxError);
/// Every surface along the stream has the components and handles of the last one.
std::vector<std::byte> encodeIsostarOfOneTopology(const Subject&, double maxError);
/// With a further isovalue on top.
std::vector<std::byte> encodeIsostarWith(const Subject&, double further, double maxError);
std::vector<std::byte> encodeIsostarLossless(const Subject&);

/// A decoder that has decoded the whole prefix. Throws a Failure on any error except truncation.
Decoder decodeIsostar(std::span<const std::byte> prefix, const RunTasks& = {});

/// The marching cubes mesh of the decoder, in sample indices.
Mesh meshOf(const Decoder&, bool normals);

}  // namespace isostar::bench
