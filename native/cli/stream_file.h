#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "isostar/isostar.h"

namespace isostar::native {

/// A native process may spend what the machine has, where the library's defaults suit a browser
/// tab.
Limits nativeLimits();

/// Header and layer heads; fails with one line naming `path`.
StreamInfo inspectStream(std::span<const std::byte>, const std::string& path);

/// All that a stream, or a prefix of one, can show. Fails with one line where it is damaged, or
/// ends within its header.
Decoder decodeStream(std::span<const std::byte>, const std::string& path);

/// Fails with one line where a stream has no such isovalue, nor two around it.
void requireIsovalue(const std::optional<double>& isovalue, const StreamInfo&,
                     const std::string& path);

/// The decoder's surface; fails with one line naming `path`.
Mesh surfaceOf(const Decoder&, const MeshOptions&, const std::string& path);

}  // namespace isostar::native
