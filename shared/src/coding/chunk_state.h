// One chunk of a level: its signs, displacements and scalars, coded without its neighbours.
#pragma once

#include <bit>
#include <memory>

#include "coding/geometry_state.h"
#include "coding/signs/refinement_coder.h"
#include "grid/chunk.h"
#include "util/cold_path.h"

namespace isostar {

/// Contexts see the coarser level's signs beyond the chunk, and none of the neighbours' geometry,
/// so that chunks can be coded in any order. Geometry sees which edges across the border cross: the
/// signs of all chunks are coded before it.
template <int D>
class ChunkState {
 public:
  /// `coarser`: the signs of the whole level before. `level`: the table of the chunk's level.
  ISOSTAR_COLD ChunkState(const Chunk<D>& chunk, const Signs<D>& coarser,
                          const BrickTable<D>& level)
      : indices_(chunk.indicesIn(level, BrickTable<D>(chunk.lattice), 1)),
        halo_(chunk.halo()),
        signs_(
            refined(cropped(coarser, chunk.coarser(),
                            chunk.indicesIn(coarser.table(), BrickTable<D>(chunk.coarser()), 2)))) {
  }

  /// Of a level whose signs are known; to go on with beginGeometry().
  ISOSTAR_COLD ChunkState(const Chunk<D>& chunk, const Signs<D>& level)
      : indices_(chunk.indicesIn(level.table(), BrickTable<D>(chunk.lattice), 1)),
        halo_(chunk.halo()),
        signs_(chunk.lattice) {}

  /// By brick index of the chunk: the index in the whole level's table.
  [[nodiscard]] const std::vector<std::size_t>& indices() const { return indices_; }
  /// By brick index: 1 for bricks of the halo.
  [[nodiscard]] const std::vector<uint8_t>& halo() const { return halo_; }
  [[nodiscard]] const Signs<D>& signs() const { return signs_; }
  /// Bytes in use.
  [[nodiscard]] ISOSTAR_COLD uint64_t memory() const {
    return sizeof(ChunkState) + geometry_.magnitudes.memory() + signs_.memory() +
           halo_.size() * (sizeof(std::size_t) + 2) + geometry_.scalars.memory() +
           geometry_.displacements.memory();
  }

  /// Does the surface of the coarser level touch the chunk? Then its signs are coded.
  [[nodiscard]] ISOSTAR_COLD bool hasSigns() const {
    const auto active = activeBricks(signs_);
    for (std::size_t i = 0; i < halo_.size(); ++i) {
      if (halo_[i] == 0 && active[i] != 0) return true;
    }
    return false;
  }
  /// Are some signs others than those of the coarser level? `actual`: of the chunk's lattice, none
  /// of whose bricks has both signs here. For an encoder.
  [[nodiscard]] bool differs(const Signs<D>& actual) const {
    for (std::size_t i = 0; i < halo_.size(); ++i) {
      if (halo_[i] == 0 && actual.slot(i) != signs_.slot(i)) return true;
    }
    return false;
  }
  /// Copies the marks of active bricks that the chunk owns, by brick index of the level.
  void joinActive(std::vector<uint8_t>& active) const {
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      if (halo_[i] == 0) active[indices_[i]] = geometry_.active[i];
    }
  }
  /// Is there a surface in it? Known from beginGeometry() on.
  [[nodiscard]] bool hasGeometry() const {
    return std::any_of(geometry_.active.begin(), geometry_.active.end(),
                       [](uint8_t mark) { return mark != 0; });
  }

  /// `coder`: with the bit models to start from.
  template <SignExchange Exchange>
  void codeSigns(Exchange& exchange, RefinementCoder<D>& coder) {
    coder.code(exchange, signs_, nullptr, &halo_);
  }
  /// Copies the signs that the chunk owns.
  ISOSTAR_COLD void joinSigns(Signs<D>& level) const {
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      if (halo_[i] == 0) level.put(indices_[i], signs_.brickAt(i));
    }
  }

  /// Takes the signs around the chunk from its level, when all chunks are coded.
  ISOSTAR_COLD void beginGeometry(const Signs<D>& level) {
    signs_ = cropped(level, signs_.lattice(), indices_);
    geometry_.active = activeBricks(signs_);
    for (std::size_t i = 0; i < halo_.size(); ++i) {
      if (halo_[i] != 0) geometry_.active[i] = 0;
    }
  }
  /// `fitted`: a property of the whole stream.
  template <class Exchange>
  ISOSTAR_COLD void codePass(Exchange& exchange, const GeometryPass<D>& pass,
                             SmoothingFilter filter, bool fitted) {
    // Its models are too large to keep them for each chunk.
    const auto exponents = pass.kind == LayerKind::Exponents ? std::make_unique<ExponentCoder<D>>()
                                                             : std::unique_ptr<ExponentCoder<D>>();
    geometry_.codePass(exchange, signs_, pass, filter, fitted, exponents.get());
    if (pass.kind == LayerKind::Exponents && exchange.charge(memoryToAssume()))
      assumeFarEnds(pass.members == Members::DiagonalEnds);
  }
  /// Bytes that joinGeometry() takes in the level's tables, at most.
  [[nodiscard]] ISOSTAR_COLD uint64_t memoryToJoin() const {
    return (2 * geometry_.scalars.brickCount() + geometry_.displacements.brickCount()) *
           Scalars<D>::kBytesToRefer;
  }
  /// Adds the geometry that the chunk owns to that of its level. Later passes change it there, too.
  ISOSTAR_COLD void joinGeometry(GeometryState<D>& level) {
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      if (halo_[i] != 0) continue;
      const std::size_t index = indices_[i];
      if (geometry_.scalars.tableSize() != 0) joinScalars(i, index, level.scalars);
      if (geometry_.displacements.tableSize() != 0 && geometry_.displacements.has(i) &&
          !level.displacements.has(index))
        level.displacements.refer(index, geometry_.displacements.writable(i));
    }
  }

 private:
  void joinScalars(std::size_t own, std::size_t index, Scalars<D>& level) {
    if (geometry_.scalars.hasGradient(own))
      level.setGradient(index, geometry_.scalars.gradient(own));
    if (geometry_.scalars.has(own) && !level.has(index))
      level.refer(index, geometry_.scalars.writable(own));
  }

  /// Scalars beyond the border are not known, but how precisely those within must be depends on
  /// them: the surface is taken to cross edges to them halfway, where it is most sensitive.
  ISOSTAR_COLD void assumeFarEnds(bool diagonals) {
    const auto& table = signs_.table();
    for (std::size_t i = 0; i < halo_.size(); ++i) {
      if (halo_[i] != 0 || !geometry_.scalars.has(i) || !besideHalo(i)) continue;
      VertexSet<D> known = geometry_.scalars.at(i).members[0];
      for (std::size_t w = 0; w < known.words.size(); ++w)
        known.words[w] |= geometry_.scalars.at(i).members[1].words[w];
      const auto brick = table.brick(i);
      known.forEach([&](std::size_t r, int x) {
        const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
        if (geometry_.scalars.at(i).knows(v) && isOnSide(v))
          assumeAround(vertexOf<D>(brick, v), i, v, diagonals);
      });
    }
  }
  /// Bytes of scalars in use then, at most.
  [[nodiscard]] ISOSTAR_COLD uint64_t memoryToAssume() const {
    const auto& table = signs_.table();
    std::vector<uint8_t> made(halo_.size());
    for (std::size_t i = 0; i < halo_.size(); ++i) {
      if (halo_[i] != 0 || !geometry_.scalars.has(i) || !besideHalo(i)) continue;
      for (const std::size_t other : table.around(table.brick(i))) {
        if (other != BrickTable<D>::kNowhere && halo_[other] != 0 && !geometry_.scalars.has(other))
          made[other] = 1;
      }
    }
    return geometry_.scalars.memory() +
           Scalars<D>::memoryOf(0, static_cast<uint64_t>(std::count(made.begin(), made.end(), 1))) +
           made.size();
  }
  /// Has the vertex of that number neighbours in other bricks?
  [[nodiscard]] static bool isOnSide(std::size_t number) {
    bool on = false;
    for (int a = 0; a < D; ++a, number /= kBrickSide) on = on || (number + 1) % kBrickSide < 2;
    return on;
  }
  [[nodiscard]] ISOSTAR_COLD bool besideHalo(std::size_t brickIndex) const {
    const auto& table = signs_.table();
    for (const std::size_t other : table.around(table.brick(brickIndex))) {
      if (other != BrickTable<D>::kNowhere && halo_[other] != 0) return true;
    }
    return false;
  }
  ISOSTAR_COLD void assumeAround(const Coordinates<D>& v, std::size_t brickIndex,
                                 std::size_t number, bool diagonals) {
    const int32_t value = geometry_.scalars.at(brickIndex).value[number];
    const auto assume = [&](const Coordinates<D>& other) {
      const std::size_t brick = signs_.table().brickIndexOf(other);
      if (halo_[brick] == 0 || signs_.at(other) == (value > 0)) return;
      auto& theirs = geometry_.scalars.writable(brick).value[numberOf<D>(other)];
      theirs = theirs == Scalars<D>::kUnknown ? -value : between(theirs, value);
    };
    Coordinates<D> low, high;
    for (int a = 0; a < D; ++a) {
      low[a] = std::max(v[a] - 1, 0);
      high[a] = std::min(v[a] + 1, signs_.lattice().last[a]);
    }
    // Vertices assumed earlier count: the order is that of coordinates, with diagonals and without.
    for (int a = D - 1; a >= 0 && !diagonals; --a) {
      Coordinates<D> other = v;
      other[a] = low[a];
      if (v[a] % kBrickSide == 0 && other != v) assume(other);
    }
    for (int a = 0; a < D && !diagonals; ++a) {
      Coordinates<D> other = v;
      other[a] = high[a];
      if ((v[a] + 1) % kBrickSide == 0 && other != v) assume(other);
    }
    if (!diagonals) return;
    forEachBetween<D>(low, high, [&](const Coordinates<D>& other) {
      int axes = 0, odd = 0;
      for (int a = 0; a < D; ++a) {
        axes += other[a] != v[a] ? 1 : 0;
        odd += other[a] != v[a] ? v[a] & 1 : 0;
      }
      // A diagonal's ends are even on all its axes, or odd on all.
      if (axes == 1 || (axes > 1 && (odd == 0 || odd == axes))) assume(other);
    });
  }
  /// A value of `theirs`' sign, about as far from one size as from the other.
  [[nodiscard]] static int32_t between(int32_t theirs, int32_t own) {
    const int bits = std::bit_width(static_cast<uint32_t>(std::abs(theirs))) +
                     std::bit_width(static_cast<uint32_t>(std::abs(own)));
    const int32_t size = int32_t{1} << (bits / 2 - 1);
    return theirs > 0 ? size : -size;
  }

  std::vector<std::size_t> indices_;
  std::vector<uint8_t> halo_;
  Signs<D> signs_;
  GeometryState<D> geometry_;
};

}  // namespace isostar
