#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "isostar/isostar.h"

namespace isostar::native {

/// Limits for a native process: three quarters of the machine's memory, where the library's
/// defaults suit a browser tab.
Limits nativeLimits();

/// Reads the header and the layer heads. Throws a Failure naming `path`.
StreamInfo inspectStream(std::span<const std::byte>, const std::string& path);

/// Decodes a stream or a prefix of one. Throws a Failure if it is damaged or ends inside its
/// header.
Decoder decodeStream(std::span<const std::byte>, const std::string& path);

/// Decodes what a region takes of a stream, and reads no more of the file. `read` receives how many
/// bytes that were, `milliseconds` how long reading took. Throws a Failure as decodeStream().
Decoder decodeRegion(const std::string& path, const Region&, uint64_t& read, double& milliseconds);

/// Whether the layer in which the first `length` bytes of a stream end is damaged. False where the
/// stream ends earlier than that layer.
bool isDamaged(std::span<const std::byte>, size_t length);

/// Throws a Failure if the isovalue is outside the range of the stream's isovalues.
void requireIsovalue(const std::optional<double>& isovalue, const StreamInfo&,
                     const std::string& path);

/// The decoder's surface. Throws a Failure naming `path`.
Mesh surfaceOf(const Decoder&, const MeshOptions&, const std::string& path);

}  // namespace isostar::native
