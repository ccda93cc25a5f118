#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "encoder/adaptive/encode_adaptive.h"
#include "encoder/uniform_writer.h"

namespace isostar {
namespace {

/// How far a crossing may move along an edge for a distance in grid steps along the smallest
/// spacing; edges along several axes only count for tetrahedra.
template <int D>
typename MagnitudeCoder<D>::Allowed allowed(const Header& header, double distance) {
  typename MagnitudeCoder<D>::Allowed result{};
  for (unsigned axes = 1; axes < result.size(); ++axes) {
    if (header.polygonizer == Polygonizer::Cubes && !std::has_single_bit(axes)) continue;
    result[axes] = static_cast<uint32_t>(
        std::clamp(65536 * distance / edgeLength(header.placement, axes), 0.0, 65536.0));
  }
  // The last also says whether diagonals count: even where nothing may move they do.
  if (header.polygonizer == Polygonizer::Tetrahedra) result.back() = std::max(result.back(), 1u);
  return result;
}

/// One pass, for all scalars that the stream's polygonizer needs.
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

/// Octaves, then halvings to half the distance each, until the bound holds.
template <int D>
void codeGeometry(UniformWriter<D>& layers, const Header& header) {
  constexpr double kCoarsest = 0.1;  // octaves alone are nearly as good
  constexpr double kFinestOfLossless = 0.025;
  constexpr double kFinest = 1e-6;  // all is told
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
  if (header.lossless) return;
  // What moves a crossing is judged to first order. Where that was not enough, the bricks concerned
  // go further.
  for (distance = bound / 2; distance > bound / 64; distance /= 2) {
    auto brickIndices = layers.beyond(bound);
    if (brickIndices.empty()) return;
    layers.select(std::move(brickIndices));
    GeometryPass<D> repair = magnitudePass<D>(header, distance);
    repair.selective = true;
    codePass(layers, header, repair);
  }
}

constexpr uint64_t kFewestDisplaced =
    1000;  // vertices: below that a layer's head takes too large a part

/// Does a pass leave at most such a share of the error?
template <int D>
bool pays(const DisplacementPlan<D>& plan, const Displacements<D>& coded,
          const typename DisplacementPlan<D>::Next& next, const DisplacementPass& pass,
          double share) {
  return plan.error(plan.reached(coded, next.steps, pass)) <= share * next.error;
}

/// One pass on the octave before the finest, where it pays: the finer octave's signs tell most of
/// it again.
template <int D>
void codeCoarseDisplacements(UniformWriter<D>& layers) {
  constexpr DisplacementPass kPass{2, 12};
  constexpr double kWorthItsBytes = 0.87;  // so much of the error is left
  const DisplacementPlan<D> plan = layers.displacementPlan();
  auto next = plan.next(layers.displacements(), kPass);
  if (pays(plan, layers.displacements(), next, kPass, kWorthItsBytes))
    layers.displace(kPass, std::move(next.steps));
}

/// Displacements come before scalars, of cubes of 4 vertices, then of 2, and once more of half the
/// step where that pays: scalars tell them nearly as well later, and smooth surfaces gain most.
template <int D>
void codeDisplacements(UniformWriter<D>& layers) {
  constexpr std::array<DisplacementPass, 3> kPasses{{{2, 12}, {1, 12}, {1, 6}}};
  constexpr double kNear = 0.09,
                   kWorthItsBytes =
                       0.835;  // grid steps before the last pass, and so much of that is left
  const DisplacementPlan<D> plan = layers.displacementPlan();
  for (const DisplacementPass& pass : kPasses) {
    auto next = plan.next(layers.displacements(), pass);
    if (&pass == &kPasses.back() &&
        (next.error > kNear || !pays(plan, layers.displacements(), next, pass, kWorthItsBytes)))
      return;
    layers.displace(pass, std::move(next.steps));
  }
}

/// Further isovalues in the order in which they are told: the one nearest to one told before comes
/// next.
std::vector<double> byNearness(double first, std::vector<double> others) {
  std::vector<double> coded{first};
  const auto distance = [&](double value) {
    double least = std::abs(value - first);
    for (const double t : coded) least = std::min(least, std::abs(value - t));
    return least;
  };
  while (!others.empty()) {
    const auto next = std::min_element(others.begin(), others.end(), [&](double a, double b) {
      return distance(a) < distance(b);
    });
    coded.push_back(*next);
    others.erase(next);
  }
  coded.erase(coded.begin());
  return coded;
}

/// All isovalues are finite, and no two are the same.
bool distinct(const EncodeOptions& options) {
  std::vector<double> all = options.furtherIsovalues;
  all.push_back(options.isovalue);
  if (!std::all_of(all.begin(), all.end(), [](double v) { return std::isfinite(v); })) return false;
  std::sort(all.begin(), all.end());
  return std::adjacent_find(all.begin(), all.end()) == all.end();
}

Error put(Header& header, const std::vector<std::byte>& layers, const EncodeOptions& options,
          std::vector<std::byte>& out) {
  header.bytes = layers.size();
  ByteWriter writer(out);
  write(writer, header);
  out.insert(out.end(), layers.begin(), layers.end());
  if (options.progress) options.progress(1);
  return Error::None;
}

/// Does all that does not depend on whose samples they are; the header already tells size and
/// placement. `domain`: empty where it is the box.
template <int D>
Error encodeGrid(std::span<const float> samples, std::span<const float> domain, Header header,
                 const EncodeOptions& options, std::vector<std::byte>& out) {
  Coordinates<D> size;
  std::copy_n(header.size.begin(), D, size.begin());
  if (options.effort < 1 || options.effort > EncodeOptions::kMostEffort) return Error::BadArgument;
  const bool bounded =
      options.lossless || (options.maxError > 0 && std::isfinite(options.maxError));
  if (options.preserveTopology && D != 3) return Error::BadArgument;
  if (options.adaptive && (options.lossless || D == 4 || !options.furtherIsovalues.empty()))
    return Error::BadArgument;
  if (!bounded || !invertible(header.placement) || !sensible<D>(samples, size, options.isovalue))
    return Error::BadArgument;
  if (options.furtherIsovalues.size() > Header::kMostFurther || !distinct(options))
    return Error::BadArgument;
  header.trimmed = !domain.empty();
  if (header.trimmed && (!sensible<D>(domain, size, 0) || options.preserveTopology ||
                         !options.furtherIsovalues.empty()))
    return Error::BadArgument;
  header.isovalue = options.isovalue;
  header.furtherIsovalues = byNearness(options.isovalue, options.furtherIsovalues);
  header.polygonizer = options.polygonizer;
  header.lossless = options.lossless;
  header.keepsTopology = options.preserveTopology;
  header.fitted = options.effort > 1;
  header.maxError = options.lossless ? 0 : std::clamp(options.maxError, 1e-9, 1e9);
  std::deque<Source<D>> sources;
  sources.emplace_back(samples, size, options.isovalue);
  for (const double isovalue : header.furtherIsovalues)
    sources.emplace_back(samples, size, isovalue);
  Precision precision;
  for (const Source<D>& source : sources)
    precision.add(source.precision(header.polygonizer), source.isovalue() - header.isovalue);
  precision.fix(header);
  header.vertices = sources.front().crossings();
  std::optional<GridField<D>> end;
  if (header.trimmed) end.emplace(domain, size, 0);
  for (Source<D>& source : sources) source.measureIn(header, end ? &*end : nullptr);
  Header adaptiveHeader = header;
  std::vector<std::byte> adaptive;
  if constexpr (D < 4) {
    if (options.adaptive && !options.preserveTopology && !header.trimmed && header.vertices != 0) {
      adaptiveHeader.adaptive = true;
      if (!encodeAdaptive(sources.front().field(), options, sources.front().signs(), adaptiveHeader,
                          adaptive))
        adaptive.clear();
    }
  }
  UniformWriter<D> layers(header, options, sources.front());
  const bool displaces =
      D > 2 &&
      header.vertices >= kFewestDisplaced;  // a block of an image has as many vertices as edges
  layers.signs([&](int level) {
    if (displaces && level + 1 == header.finestLevel()) codeCoarseDisplacements(layers);
  });
  if (header.trimmed && header.vertices != 0) layers.domain();
  if (header.vertices != 0) {
    if (displaces) codeDisplacements(layers);
    codeGeometry(layers, header);
  }
  for (std::size_t i = 1; i < sources.size(); ++i) {
    layers.furtherSigns(static_cast<int>(i), sources[i]);
    if (sources[i].crossings() != 0) codeGeometry(layers, header);
  }
  // Where coarse simplices do not pay, there are none.
  if (!adaptive.empty() && adaptive.size() < layers.bytes().size())
    return put(adaptiveHeader, adaptive, options, out);
  return put(header, layers.bytes(), options, out);
}

}  // namespace

Error encode(const Image& image, const EncodeOptions& options, std::vector<std::byte>& out) {
  return encodeGrid<2>(image.samples, {}, headerOf(image), options, out);
}
Error encode(const Volume& volume, const EncodeOptions& options, std::vector<std::byte>& out) {
  return encodeGrid<3>(volume.samples, volume.domain, headerOf(volume), options, out);
}
Error encode(const Sequence& sequence, const EncodeOptions& options, std::vector<std::byte>& out) {
  return encodeGrid<4>(sequence.samples, {}, headerOf(sequence), options, out);
}

}  // namespace isostar
