// The sequence of layers of a uniform stream: which passes the encoder codes, and when.
#pragma once

#include <algorithm>
#include <deque>

#include "encoder/uniform_writer.h"

namespace isostar {

/// How far a crossing may move along each kind of edge, for a distance in grid steps along the
/// smallest spacing. Edges along several axes count for Polygonizer::Tetrahedra only.
template <int D>
typename MagnitudeCoder<D>::Allowed allowed(const Header& header, double distance) {
  typename MagnitudeCoder<D>::Allowed result{};
  for (unsigned axes = 1; axes < result.size(); ++axes) {
    if (header.polygonizer == Polygonizer::Cubes && !std::has_single_bit(axes)) continue;
    result[axes] = static_cast<uint32_t>(
        std::clamp(65536 * distance / edgeLength(header.placement, axes), 0.0, 65536.0));
  }
  // The last entry also says whether diagonals count: they do, even if nothing may move.
  if (header.polygonizer == Polygonizer::Tetrahedra) result.back() = std::max(result.back(), 1u);
  return result;
}

/// Codes a pass over all scalars that the stream's polygonizer needs.
template <int D>
void codePass(UniformWriter<D>& layers, const Header& header, GeometryPass<D> pass) {
  layers.geometry(pass);
  if (header.polygonizer == Polygonizer::Cubes) return;
  pass.members = Members::DiagonalEnds;
  layers.geometry(pass);
}

template <int D>
GeometryPass<D> magnitudePass(const Header& header, double distance) {
  return {.kind = LayerKind::Magnitudes, .allowed = allowed<D>(header, distance), .most = 30};
}

/// Codes exponents, then refinements, each for half the previous distance, until the bound holds.
template <int D>
void codeGeometry(UniformWriter<D>& layers, const Header& header) {
  // Grid steps; for larger distances exponents alone are nearly as good.
  constexpr double kCoarsest = 0.1;
  constexpr double kFinestOfLossless = 0.025;
  constexpr double kFinest = 1e-6;  // grid steps; all bits are coded then
  const double bound = header.lossless ? 0 : std::max(double{header.maxError}, kFinest);
  codePass<D>(layers, header,
              {.kind = LayerKind::Exponents,
               .exponentRange = bound > 0.3    ? 1
                                : bound > 0.15 ? 2
                                               : 3});
  double distance = header.lossless ? kFinestOfLossless : bound;
  while (distance * 2 < kCoarsest) distance *= 2;
  for (; distance > (header.lossless ? kFinestOfLossless * 0.9 : bound * 1.1);
       distance /= header.lossless ? 4 : 2) {
    codePass(layers, header, magnitudePass<D>(header, distance));
  }
  codePass(layers, header, magnitudePass<D>(header, bound));
  auto beyondBound = layers.beyond(bound);
  if (header.lossless) return;
  // Movements of crossings are estimated to first order. Where the bound does not hold yet, the
  // bricks concerned are refined further.
  for (distance = bound / 2; !beyondBound.empty() && distance > bound / 64; distance /= 2) {
    layers.select(beyondBound);
    GeometryPass<D> repair = magnitudePass<D>(header, distance);
    repair.selective = true;
    codePass(layers, header, repair);
    beyondBound = layers.beyond(bound, beyondBound);
  }
}

/// Displacements are coded for at least this many vertices; with fewer, the layer's head is too
/// large a part.
inline constexpr uint64_t kFewestDisplaced = 1000;

/// Does a pass leave at most `share` of the error?
template <int D>
bool isWorthItsBytes(const DisplacementPlan<D>& plan, const Displacements<D>& coded,
                     const typename DisplacementPlan<D>::Next& next, const DisplacementPass& pass,
                     double share) {
  return plan.error(plan.reached(coded, next.steps, pass)) <= share * next.error;
}

/// Codes one pass on the level before the finest, if it is worth its bytes: the finer level's signs
/// repeat most of its information.
template <int D>
void codeCoarseDisplacements(UniformWriter<D>& layers) {
  constexpr DisplacementPass kPass{2, 12};
  constexpr double kWorthItsBytes = 0.87;  // the share of the error that may be left
  const DisplacementPlan<D> plan = layers.displacementPlan();
  auto next = plan.next(layers.displacements(), kPass);
  if (isWorthItsBytes(plan, layers.displacements(), next, kPass, kWorthItsBytes))
    layers.displace(kPass, std::move(next.steps));
}

/// Codes displacements before scalars: of cubes of 4 vertices, then of 2, and then again with half
/// the step if that is worth its bytes. Scalars code the same later almost as well, and smooth
/// surfaces gain most.
template <int D>
void codeDisplacements(UniformWriter<D>& layers) {
  constexpr std::array<DisplacementPass, 3> kPasses{{{2, 12}, {1, 12}, {1, 6}}};
  constexpr double kMostError = 0.09;       // grid steps, before the last pass
  constexpr double kWorthItsBytes = 0.835;  // the share of that error that the pass may leave
  const DisplacementPlan<D> plan = layers.displacementPlan();
  for (const DisplacementPass& pass : kPasses) {
    auto next = plan.next(layers.displacements(), pass);
    if (&pass == &kPasses.back() &&
        (next.error > kMostError ||
         !isWorthItsBytes(plan, layers.displacements(), next, pass, kWorthItsBytes)))
      return;
    layers.displace(pass, std::move(next.steps));
  }
}

/// Codes all layers of a uniform stream. `sources`: by isovalue, in coding order. Returns the
/// largest distance of a vertex from its source's, measured, grid steps.
template <int D>
[[nodiscard]] double codeUniform(UniformWriter<D>& layers, const Header& header,
                                 std::deque<Source<D>>& sources) {
  double largest = 0;
  // In an image a block has as many vertices as edges.
  const bool displaces = D > 2 && header.vertices >= kFewestDisplaced;
  layers.signs(displaces, [&](int level) {
    if (displaces && level + 1 == header.finestLevel()) codeCoarseDisplacements(layers);
  });
  if (header.trimmed && header.vertices != 0) layers.domain();
  if (header.vertices != 0) {
    if (displaces) codeDisplacements(layers);
    codeGeometry(layers, header);
    largest = layers.largestError();
  }
  for (std::size_t i = 1; i < sources.size(); ++i) {
    layers.furtherSigns(static_cast<int>(i), sources[i]);
    if (sources[i].crossings() == 0) continue;
    codeGeometry(layers, header);
    largest = std::max(largest, layers.largestError());
  }
  return largest;
}

}  // namespace isostar
