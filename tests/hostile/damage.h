// Damages streams at random, by kinds.
#pragma once

#include <random>

#include "stream_layout.h"

namespace isostar {

enum class Damage {
  FlippedBits,
  OverwrittenBytes,
  ChangedLength,
  CutEnd,
  SwappedLayers,
  RepeatedLayer,
  RemovedLayer,
};
inline constexpr std::array<const char*, 7> kDamages{
    "flipped bits",   "overwritten bytes", "changed length", "cut end",
    "swapped layers", "repeated layer",    "removed layer"};

/// A damaged stream.
struct Damaged {
  Bytes kept;    // with the checksums that it had
  Bytes mended;  // with right ones
};

class DamagedStreams {
 public:
  /// `stream`: sound.
  DamagedStreams(Bytes stream, uint64_t seed)
      : sound_(std::move(stream)),
        layout_(sound_),
        layers_(layersOf(sound_, layout_)),
        random_(seed) {}

  [[nodiscard]] const Bytes& sound() const { return sound_; }

  /// Of a stream in chunks, whose layers have no heads of their own, bytes are damaged instead.
  [[nodiscard]] Damaged next(Damage kind) {
    if (layers_.empty() && kind != Damage::FlippedBits && kind != Damage::CutEnd)
      kind = Damage::OverwrittenBytes;
    switch (kind) {
      case Damage::FlippedBits:
        return mended(withFlippedBits());
      case Damage::OverwrittenBytes:
        return mended(overwritten());
      case Damage::ChangedLength:
        return mended(withChangedLength());
      case Damage::CutEnd:
        return mended(Bytes(sound_.begin(), sound_.begin() + offset(below(sound_.size()))));
      default:
        return withOtherLayers(kind);
    }
  }

 private:
  static std::ptrdiff_t offset(std::size_t n) { return static_cast<std::ptrdiff_t>(n); }
  /// A number in 0 … limit - 1, the same on every machine.
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(random_() % limit); }

  static Damaged mended(Bytes kept) {
    Bytes bytes = kept;
    mendChecksums(bytes);
    return {std::move(kept), std::move(bytes)};
  }

  Bytes withFlippedBits() {
    Bytes bytes = sound_;
    for (std::size_t flips = 1 + below(4); flips > 0; --flips)
      bytes[below(bytes.size())] ^= std::byte{1} << below(8);
    return bytes;
  }
  Bytes overwritten() {
    constexpr std::size_t kMost = 16;
    Bytes bytes = sound_;
    const std::size_t first = below(bytes.size()),
                      count = std::min(1 + below(kMost), bytes.size() - first);
    for (std::size_t i = 0; i < count; ++i) bytes[first + i] = static_cast<std::byte>(below(256));
    return bytes;
  }

  /// A length near the right one, or of any number of bits.
  uint64_t otherLength(uint64_t length) {
    return below(2) == 0 ? length ^ (1 + below(7)) : random_() >> below(64);
  }
  /// Of the whole stream or of one layer.
  Bytes withChangedLength() {
    Header header = layout_.header;
    Bytes bytes;
    ByteWriter out(bytes);
    const std::size_t which = below(layers_.size() + 1);
    if (which == layers_.size()) header.bytes = otherLength(header.bytes);
    write(out, header);
    putChecksum(bytes, bytes.size() - 2, 2, headerSum());
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      auto [head, layer] = layers_[i];
      if (i == which) head.bytes = otherLength(head.bytes);
      write(out, head);
      bytes.insert(bytes.end(), layer.begin(), layer.end());
    }
    return bytes;
  }
  [[nodiscard]] uint32_t headerSum() const {
    const auto at = layout_.headerEnd - 2;
    return static_cast<uint32_t>(sound_[at]) | static_cast<uint32_t>(sound_[at + 1]) << 8;
  }

  /// Layers are copied with their heads. The mended stream's header states its new length.
  Damaged withOtherLayers(Damage kind) {
    Layers layers = layers_;
    const std::size_t which = below(layers.size());
    const auto at = layers.begin() + offset(which);
    if (kind == Damage::SwappedLayers) {
      std::swap(*at, layers[(which + below(layers.size())) % layers.size()]);
    } else if (kind == Damage::RepeatedLayer) {
      const auto repeated = *at;
      layers.insert(layers.begin() + offset(below(layers.size() + 1)), repeated);
    } else {
      layers.erase(at);
    }
    Bytes kept(sound_.begin(), sound_.begin() + offset(layout_.headerEnd));
    ByteWriter out(kept);
    for (const auto& [head, layer] : layers) {
      write(out, head);
      kept.insert(kept.end(), layer.begin(), layer.end());
    }
    return {std::move(kept), assembled(layout_.header, layers)};
  }

  Bytes sound_;
  StreamLayout layout_;
  Layers layers_;
  std::mt19937_64 random_;
};

}  // namespace isostar
