// Polygonizes a source directly, without a stream.
#include "encoder/core/quantization.h"
#include "encoder/core/quantized_field.h"
#include "grid/refined_signs.h"
#include "grid/tube.h"
#include "isostar/isostar.h"
#include "surface/contour.h"
#include "surface/polygonizer.h"
#include "surface/time_slice.h"

namespace isostar {
namespace {

/// The samples are the caller's own.
constexpr Limits kUnlimited{UINT64_MAX, UINT64_MAX, UINT64_MAX};

/// Calls make(surface) with the exact scalars of a source, and with its distances to the domain's
/// boundary as a lossless stream has them.
template <int D, class Make>
Error withSource(std::span<const float> samples, std::span<const float> domain, Header header,
                 double isovalue, Polygonizer polygonizer, Make make) {
  Coordinates<D> size;
  std::copy_n(header.size.begin(), D, size.begin());
  if (!invertible(header.placement) || !sensible<D>(samples, size, isovalue))
    return Error::BadArgument;
  if (!domain.empty() && !sensible<D>(domain, size, 0)) return Error::BadArgument;
  const RunTasks inOrder;
  const Source<D> source(samples, size, isovalue, inOrder);
  const auto& field = source.field();
  const auto& signs = source.signs();
  const auto& active = source.active();
  header.isovalue = isovalue;
  header.lossless = true;
  header.polygonizer = polygonizer;
  source.precision(polygonizer).fix(header);
  const double error =
      chooseStep(header, kLosslessError / kQuantizationShare,
                 [&](const Header& stream) { return quantizationError(stream, source); });
  if (error > kLosslessError) return Error::BadArgument;
  const GridField<D> end(domain, size, 0);
  Scalars<D> scalars(active.size()), distances(domain.empty() ? 0 : active.size());
  Tube<D> tube;
  for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
    if (members == Members::DiagonalEnds && polygonizer == Polygonizer::Cubes) break;
    for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
      if (active[brickIndex] == 0) continue;
      tube.enter(signs, brickIndex, members);
      if (tube.empty()) continue;
      auto& brick = scalars.writable(brickIndex);
      tube.forEach([&](int row, std::size_t r, int x) {
        const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
        brick.set(v, tube.positive(row, x), field.magnitude(header, brickIndex, r, x), 0);
        if (!domain.empty())
          distances.writable(brickIndex).value[v] =
              2 * domainSteps(end, header, brickIndex, r, x) + 1;
      });
    }
  }
  return make(Surface<D>{signs, scalars, 2 * header.positiveOffset - 1,
                         2 * header.negativeOffset - 1, header.placement,
                         domain.empty() ? nullptr : &distances});
}

}  // namespace

Error polygonize(const Volume& volume, double isovalue, const MeshOptions& options, Mesh& out) {
  return withSource<3>(
      volume.samples, volume.domain, headerOf(volume), isovalue, options.polygonizer,
      [&](const Surface<3>& surface) { return polygonize(surface, options, kUnlimited, {}, out); });
}

Error polygonize(const Image& image, double isovalue, const MeshOptions& options, Contours& out) {
  return withSource<2>(
      image.samples, {}, headerOf(image), isovalue, options.polygonizer,
      [&](const Surface<2>& surface) { return polygonize(surface, options, kUnlimited, out); });
}

Error polygonize(const Sequence& sequence, double isovalue, const MeshOptions& options, Mesh& out) {
  if (!(options.time >= 0 && options.time <= sequence.frames - 1)) return Error::BadArgument;
  return withSource<4>(sequence.samples, {}, headerOf(sequence), isovalue, options.polygonizer,
                       [&](const Surface<4>& surface) {
                         const TimeSlice slice = sliceAt(surface, options.time);
                         return polygonize(
                             Surface<3>{slice.signs, slice.scalars, slice.positiveOffset,
                                        slice.negativeOffset, surface.placement},
                             options, kUnlimited, {}, out);
                       });
}

}  // namespace isostar
