// The container: a header, then layers, each preceded by its head.
#pragma once

#include <span>
#include <vector>

#include "container/bytes.h"
#include "container/header.h"
#include "container/layer_kind.h"

namespace isostar {

struct LayerHead {
  LayerKind kind = LayerKind::Base;
  int level = 0;     // or the number of a further isovalue
  double error = 0;  // RMS distance to the source's surface, in grid steps, to within 5 %
  uint64_t bytes = 0;
  uint32_t checksum = 0;
};

inline constexpr uint64_t kMostLayers = 255;

void write(ByteWriter& out, const Header& header);
void write(ByteWriter& out, const LayerHead& head);
/// Appends a layer, which `number` layers precede. Sets the length and the checksum in its head.
void append(std::vector<std::byte>& out, LayerHead head, std::span<const std::byte> layer,
            std::size_t number);

/// Error::Truncated if more bytes are needed; `used` is then not set. Otherwise `used` receives the
/// size of the header or head in bytes.
[[nodiscard]] Error read(std::span<const std::byte> in, Header& out, std::size_t& used);
[[nodiscard]] Error read(std::span<const std::byte> in, const Header& header, LayerHead& out,
                         std::size_t& used);

/// Of a layer, the other fields of its head and its number: how many layers precede it. 16 bits for
/// a short layer, 32 for others.
[[nodiscard]] uint32_t checksum(const LayerHead& head, std::span<const std::byte> layer,
                                std::size_t number);
/// Of the header's bytes between the first three and the checksum itself; 16 bits.
[[nodiscard]] uint32_t checksum(std::span<const std::byte> header);

}  // namespace isostar
