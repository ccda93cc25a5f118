#include "tetrahedra/bounded_encoding.h"

#include <algorithm>
#include <cmath>

#include "files/failure.h"
#include "files/text.h"
#include "tetrahedra/grid_choice.h"
#include "tetrahedra/marching_tetrahedra.h"
#include "tetrahedra/tetrahedra_volume.h"

namespace isostar::native {
namespace {

constexpr double kMostSamples = 0x1p24;
/// The ratio of steps from one grid to the next: two to eight times the samples.
constexpr double kLeastFiner = 1.26, kMostFiner = 2;
constexpr double kSamplingPart = 0.9;  // the fraction of the bound that sampling may use
constexpr double kTries[] = {0.4, 0.3, 0.2, 0.14, 0.1, 0.05};  // the codec's bounds, in grid steps

void require(Error error, const std::string& path) {
  if (error != Error::None) throw Failure(path, describe(error));
}

Mesh decodedSurface(const std::vector<std::byte>& stream, const EncodeOptions& options,
                    const std::string& path) {
  Decoder decoder;
  decoder.accept(stream);
  decoder.finish();
  while (decoder.advance()) {
  }
  require(decoder.error(), path);
  Mesh mesh;
  require(decoder.mesh({.polygonizer = options.polygonizer, .normals = false}, mesh), path);
  return mesh;
}

double distanceOf(const std::vector<std::byte>& stream, const Mesh& isosurface,
                  const EncodeOptions& options, const std::string& path) {
  const auto distance = measure::surfaceDistance(decodedSurface(stream, options, path), isosurface);
  return distance ? distance->symmetric().max : 0;
}

/// Encodes one grid's samples with smaller and smaller bounds until the surface is within `bound`.
/// If it never is, the stream of the last try.
BoundedStream encodedWithin(double bound, LoadedVolume volume, const Mesh& isosurface,
                            EncodeOptions options, const std::string& path) {
  BoundedStream result;
  result.volume = std::move(volume);
  for (const double steps : kTries) {
    options.maxError = steps;
    result.stream.clear();
    require(encode(result.volume.view(), options, result.stream), path);
    result.distance = distanceOf(result.stream, isosurface, options, path);
    if (result.distance <= bound) break;
  }
  return result;
}

}  // namespace

BoundedStream encodeWithin(double bound, const TetrahedralField& field, EncodeOptions options,
                           const std::string& path, const std::function<void(double)>& progress) {
  const Mesh isosurface = isosurfaceOf(field.mesh(), options.isovalue);
  BoundedStream nearest;
  for (double step = suitableStep(field, options.isovalue);
       nearest.stream.empty() || nearest.distance > bound;) {
    const SampleGrid grid = gridOfStep(field, step, path);
    TetrahedraVolume sampled =
        volumeOf(field, isosurface, options.isovalue, Scalars::Distances, grid, progress);
    const double excess =
        sampled.distance ? sampled.distance->symmetric().max / (kSamplingPart * bound) : 0;
    const double finer = std::clamp(std::sqrt(excess), kLeastFiner, kMostFiner);
    const bool isLast = static_cast<double>(grid.count()) * finer * finer * finer > kMostSamples;
    step /= finer;
    if (excess > 1 && !isLast) continue;
    BoundedStream made = encodedWithin(bound, std::move(sampled.volume), isosurface, options, path);
    if (nearest.stream.empty() || made.distance < nearest.distance) nearest = std::move(made);
    if (isLast) break;
  }
  if (nearest.distance > bound)
    nearest.volume.remarks.push_back(
        text("no grid of 2^24 samples meets the bound: the surface is up to %.3g from the "
             "isosurface of the tetrahedra",
             nearest.distance));
  return nearest;
}

}  // namespace isostar::native
