// Displacements and scalars of one lattice, coded pass by pass (§5.3).
#pragma once

#include "coding/geometry/displacement_coder.h"
#include "coding/geometry/exponent_coder.h"
#include "coding/geometry/geometry_pass.h"
#include "coding/geometry/magnitude_coder.h"
#include "estimate/hints.h"
#include "util/cold_path.h"

namespace isostar {

/// What encoder and decoder share of the geometry, and the bit models that persist from pass to
/// pass, but for those of exponents, which are large.
template <int D>
struct GeometryState {
  std::vector<uint8_t> active;     // marks bricks; empty before anything is coded
  Displacements<D> displacements;  // of the last complete level
  Scalars<D> scalars;
  bool magnitudesRefined = false;  // has a magnitude refinement pass been coded?
  std::array<bool, 2> coded{};     // by Members: have scalars been coded, at least some of them?
  DisplacementCoder<D> displacing;
  MagnitudeCoder<D> magnitudes;

  /// Codes a pass; `active` must be set. `fitted`: a property of the whole stream. `exponents`:
  /// used in a pass of that kind. Not inlined, to keep the WebAssembly decoder small.
  template <class Exchange>
  [[gnu::noinline]] void codePass(Exchange& exchange, const Signs<D>& signs,
                                  const GeometryPass<D>& pass, SmoothingFilter filter, bool fitted,
                                  ExponentCoder<D>* exponents) {
    beginPass(pass);
    if (pass.kind == LayerKind::Displacement)
      displacing.code(exchange, signs, displacements, pass.displacement, active);
    else if (pass.kind == LayerKind::Exponents)
      exponents->code(exchange, signs, scalars, pass.members, pass.exponentRange, active,
                      {filter, &displacements});
    else
      magnitudes.code(exchange, signs, scalars, pass.magnitudePass(fitted), active);
    endPass(pass, !exchange.exhausted());
  }

  ISOSTAR_COLD void beginPass(const GeometryPass<D>& pass) {
    if (pass.kind == LayerKind::Displacement) {
      if (displacements.tableSize() == 0) displacements = Displacements<D>(active.size());
    } else if (scalars.tableSize() == 0) {
      scalars = Scalars<D>(active.size());
    }
    if (pass.kind == LayerKind::Exponents) coded[static_cast<std::size_t>(pass.members)] = true;
  }
  void endPass(const GeometryPass<D>& pass, bool complete) {
    magnitudesRefined = magnitudesRefined || (pass.kind == LayerKind::Magnitudes && complete);
  }
};

}  // namespace isostar
