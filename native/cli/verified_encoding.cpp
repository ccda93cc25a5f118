#include "cli/verified_encoding.h"

#include "cli/progress_bar.h"
#include "cli/stream_file.h"
#include "files/failure.h"
#include "files/text.h"
#include "measure/ribbon.h"
#include "measure/surface_distance.h"
#include "threads/parallel_tasks.h"
#include "volume/placement.h"

namespace isostar::native {
namespace {

std::vector<std::byte> encodeWithBar(const LoadedVolume& volume, EncodeOptions options,
                                     const std::string& path) {
  ProgressBar bar("encoding");
  options.runTasks = parallelTasks();
  options.progress = [&bar](double done) { bar.show(done); };
  std::vector<std::byte> stream;
  EncodeReport report;
  const Error error = volume.dimension == 2   ? encode(volume.image(), options, stream, &report)
                      : volume.dimension == 3 ? encode(volume.view(), options, stream, &report)
                                              : encode(volume.sequence(), options, stream, &report);
  if (error == Error::BadArgument && !report.holds)
    throw Failure(path,
                  text("cannot be encoded %s: its samples differ so much in size that the "
                       "surface would be up to %.3g grid steps off; --best-effort writes it "
                       "with that bound",
                       options.lossless ? "without loss" : "within the bound", report.maxError));
  if (error != Error::None) throw Failure(path, describe(error));
  return stream;
}

/// The surface of a stream in the world; of an image, its contours as a ribbon of width 1.
Mesh decodedSurface(const std::vector<std::byte>& stream, int dimension, const std::string& path) {
  Decoder decoder(nativeLimits(), parallelTasks());
  decoder.accept(stream);
  decoder.finish();
  while (decoder.advance()) {
  }
  Mesh mesh;
  Contours contours;
  Error error = decoder.error();
  if (error == Error::None)
    error =
        dimension == 2 ? decoder.contours({}, contours) : decoder.mesh({.normals = false}, mesh);
  if (error != Error::None) throw Failure(path, describe(error));
  return dimension == 2 ? measure::ribbon(contours, 1) : mesh;
}

/// The same of the samples.
Mesh sourceSurface(const LoadedVolume& volume, const EncodeOptions& options,
                   const std::string& path) {
  const MeshOptions world{.polygonizer = options.polygonizer, .normals = false};
  Mesh mesh;
  Contours contours;
  const Error error = volume.dimension == 2
                          ? polygonize(volume.image(), options.isovalue, world, contours)
                          : polygonize(volume.view(), options.isovalue, world, mesh);
  if (error != Error::None) throw Failure(path, describe(error));
  return volume.dimension == 2 ? measure::ribbon(contours, 1) : mesh;
}

bool isAdaptive(const std::vector<std::byte>& stream) {
  StreamInfo info;
  return inspect(stream, info) == Error::None && info.adaptive;
}

}  // namespace

std::vector<std::byte> encodeVerified(const LoadedVolume& volume, EncodeOptions options,
                                      const std::string& path) {
  std::vector<std::byte> stream = encodeWithBar(volume, options, path);
  if (!isAdaptive(stream)) return stream;
  constexpr int kTries = 3;
  constexpr double kNextTry = 0.75;  // of the bound before
  const double bound = options.maxError * smallestSpacing(volume.placement);
  const Mesh source = sourceSurface(volume, options, path);
  for (int i = 0; i < kTries && isAdaptive(stream); ++i) {
    const auto distance =
        measure::surfaceDistance(decodedSurface(stream, volume.dimension, path), source);
    if (distance && distance->symmetric().max <= bound) return stream;
    options.maxError *= kNextTry;
    stream = encodeWithBar(volume, options, path);
  }
  if (!isAdaptive(stream)) return stream;
  options.adaptive = false;
  options.maxError = bound / smallestSpacing(volume.placement);
  return encodeWithBar(volume, options, path);
}

}  // namespace isostar::native
