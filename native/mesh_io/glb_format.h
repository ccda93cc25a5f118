#pragma once

#include <cstdint>

/// Numbers of the GLB container and of glTF 2.0 that the writer and the reader share.
namespace isostar::native::glb {

inline constexpr uint32_t kMagic = 0x46546C67, kVersion = 2;
inline constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
inline constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125,
                     kFloat = 5126;

}  // namespace isostar::native::glb
