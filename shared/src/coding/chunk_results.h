// What a decoder gives to others that decode other chunks of the same stream, as bytes.
#pragma once

#include <cstring>

#include "coding/geometry_state.h"
#include "container/bytes.h"
#include "grid/chunk.h"
#include "util/cold_path.h"

namespace isostar {

/// The signs that a chunk owns: for each brick the slot of a uniform one, or kMixed and its rows.
template <int D>
struct SignResults {
  static constexpr uint8_t kMixed = 2;

  ISOSTAR_COLD static void write(const Signs<D>& level, const Chunk<D>& chunk, ByteWriter& out) {
    forEachBrickOf(chunk, level.table(), [&](std::size_t brickIndex) {
      const uint32_t slot = std::min<uint32_t>(level.slot(brickIndex), kMixed);
      out.u8(slot);
      if (slot != kMixed) return;
      for (const uint8_t row : level.brickAt(brickIndex).rows) out.u8(row);
    });
  }
  /// False if the bytes are not those of a chunk.
  [[nodiscard]] ISOSTAR_COLD static bool read(ByteReader& in, const Chunk<D>& chunk,
                                              Signs<D>& level) {
    bool sane = true;
    forEachBrickOf(chunk, level.table(), [&](std::size_t brickIndex) {
      const uint32_t slot = in.u8();
      sane = sane && slot <= kMixed && !in.overrun();
      if (!sane) return;
      Brick<D> brick = level.brick(slot == Signs<D>::kPositive ? slot : Signs<D>::kNegative);
      for (uint8_t& row : brick.rows) {
        if (slot == kMixed) row = static_cast<uint8_t>(in.u8());
      }
      level.put(brickIndex, brick);
    });
    return sane && !in.overrun();
  }
};

/// The geometry of chunks' bricks near their borders, up to a zero.
template <int D>
class GeometryResults {
 public:
  ISOSTAR_COLD static void write(const GeometryState<D>& whole, const BrickTable<D>& table,
                                 const Chunk<D>& chunk, ByteWriter& out) {
    forEachBrickOf(chunk, table, [&](std::size_t brickIndex) {
      if (!isNearBorder(table, chunk, table.brick(brickIndex))) return;
      const bool gradient = whole.scalars.tableSize() != 0 && whole.scalars.hasGradient(brickIndex),
                 scalars = whole.scalars.tableSize() != 0 && whole.scalars.has(brickIndex),
                 displacements =
                     whole.displacements.tableSize() != 0 && whole.displacements.has(brickIndex);
      if (!gradient && !scalars && !displacements) return;
      out.varint(brickIndex + 1);
      out.u8((gradient ? kGradient : 0u) | (scalars ? kScalars : 0u) |
             (displacements ? kDisplacements : 0u));
      if (gradient) out.u8(static_cast<uint64_t>(whole.scalars.gradient(brickIndex)));
      if (scalars) {
        append(whole.scalars.at(brickIndex).value, out);
        append(whole.scalars.at(brickIndex).members, out);
      }
      if (displacements) append(whole.displacements.at(brickIndex), out);
    });
  }
  /// False if the bytes are not those of a chunk whose passes `whole` has, too.
  [[nodiscard]] ISOSTAR_COLD static bool read(ByteReader& in, const std::vector<uint8_t>& own,
                                              GeometryState<D>& whole) {
    for (;;) {
      const uint64_t number = in.varint();
      if (in.overrun() || in.malformed()) return false;
      if (number == 0) return true;
      const std::size_t brickIndex = number - 1;
      const uint32_t parts = in.u8();
      if (number > own.size() || own[brickIndex] != 0 || parts > kAll) return false;
      if ((parts & (kGradient | kScalars)) != 0 && whole.scalars.tableSize() == 0) return false;
      if ((parts & kDisplacements) != 0 && whole.displacements.tableSize() == 0) return false;
      if ((parts & kGradient) != 0) {
        const uint32_t gradient = in.u8();
        if (gradient > kMostGradient) return false;
        whole.scalars.setGradient(brickIndex, static_cast<int>(gradient));
      }
      if ((parts & kScalars) != 0) {
        auto& brick = whole.scalars.writable(brickIndex);
        if (!take(in, brick.value) || !take(in, brick.members) || !isSound(brick)) return false;
      }
      if ((parts & kDisplacements) != 0 && !take(in, whole.displacements.writable(brickIndex)))
        return false;
    }
  }

 private:
  static constexpr uint32_t kMostGradient = 4 * 30;
  enum Part : uint32_t { kGradient = 1, kScalars = 2, kDisplacements = 4, kAll = 7 };

  [[nodiscard]] static bool isNearBorder(const BrickTable<D>& table, const Chunk<D>& chunk,
                                         const Coordinates<D>& brick) {
    bool near = false;
    for (int a = 0; a < D; ++a) {
      near = near || (chunk.begin[a] > 0 && brick[a] < chunk.begin[a] + Chunk<D>::kHalo) ||
             (chunk.end[a] < table.count(a) && brick[a] >= chunk.end[a] - Chunk<D>::kHalo);
    }
    return near;
  }
  [[nodiscard]] static bool isSound(const ScalarBrick<D>& brick) {
    constexpr int32_t kMost = 1 << 30;
    const auto isScalar = [](int32_t value) {
      return value == Scalars<D>::kUnknown || (value != 0 && value > -kMost && value < kMost);
    };
    bool sound = std::all_of(brick.value.begin(), brick.value.end(), isScalar);
    for (const auto& members : brick.members) {
      members.forEach([&](std::size_t r, int x) {
        sound = sound && brick.knows(r * kBrickSide + static_cast<std::size_t>(x));
      });
    }
    return sound;
  }
  template <class Values>
  static void append(const Values& values, ByteWriter& out) {
    out.append(std::as_bytes(std::span(values)));
  }
  template <class Values>
  [[nodiscard]] static bool take(ByteReader& in, Values& values) {
    const auto bytes = in.take(sizeof(values));
    if (bytes.size() != sizeof(values)) return false;
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return true;
  }
};

}  // namespace isostar
