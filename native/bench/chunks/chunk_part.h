// What a decoder of one chunk would know.
#pragma once

#include <memory>

#include "coding/codec_state.h"
#include "grid/chunk.h"

namespace isostar::bench {

/// All bit models of a uniform volume's traversal.
struct ChunkModels {
  RefinementCoder<3> refinement;
  DisplacementCoder<3> displacing;
  ExponentCoder<3> exponents;
  MagnitudeCoder<3> magnitudes;
};

/// A chunk of one level: its signs, then its displacements and scalars. `actual`: the level's
/// signs, in the chunk's own lattice.
struct ChunkPart {
  /// `level`, `coarser`: the signs of the chunk's level and of the one before.
  ChunkPart(const Chunk<3>& chunk, const Signs<3>& level, const Signs<3>& coarser)
      : table(chunk.lattice),
        indices(chunk.indicesIn(level.table(), table, 1)),
        halo(chunk.halo()),
        actual(cropped(level, chunk.lattice, indices)),
        signs(
            refined(cropped(coarser, chunk.coarser(),
                            chunk.indicesIn(coarser.table(), BrickTable<3>(chunk.coarser()), 2)))),
        displacements(indices.size()),
        scalars(indices.size()) {}

  template <class Exchange>
  void codeSigns(Exchange& exchange, ChunkModels& models) {
    models.refinement.code(exchange, signs, nullptr, &halo);
    // Geometry sees the neighbours' signs.
    signs = actual;
    active = activeBricks(signs);
    for (std::size_t i = 0; i < active.size(); ++i) {
      if (halo[i] != 0) active[i] = 0;
    }
  }

  template <class Exchange>
  void codeGeometry(Exchange& exchange, ChunkModels& models, const GeometryPass<3>& pass,
                    SmoothingFilter filter, bool fitted) {
    if (pass.kind == LayerKind::Displacement)
      models.displacing.code(exchange, signs, displacements, pass.displacement, active);
    else if (pass.kind == LayerKind::Exponents)
      models.exponents.code(exchange, signs, scalars, pass.members, pass.exponentRange, active,
                            {filter, &displacements});
    else
      models.magnitudes.code(exchange, signs, scalars, pass.magnitudePass(fitted), active);
  }

  BrickTable<3> table;
  std::vector<std::size_t> indices;  // of the chunk's bricks in the level's table
  std::vector<uint8_t> halo;
  Signs<3> actual, signs;
  std::vector<uint8_t> active;
  Displacements<3> displacements;
  Scalars<3> scalars;
  std::unique_ptr<ChunkModels> models;  // null where all chunks share models
};

}  // namespace isostar::bench
