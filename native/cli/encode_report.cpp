#include "cli/encode_report.h"

#include <algorithm>

#include "cli/limit_warning.h"
#include "cli/messages.h"
#include "cli/stopwatch.h"
#include "files/failure.h"
#include "files/text.h"
#include "volume/placement.h"
#include "volume/precision.h"

namespace isostar::native {
namespace {

/// The bound in the unit of --units.
double boundInUnits(const EncodeArguments& arguments, const Placement& placement) {
  const double bound = arguments.options.maxError;
  return arguments.units == Units::World ? bound * smallestSpacing(placement) : bound;
}

const char* unitOf(const EncodeArguments& arguments) {
  return arguments.units == Units::World ? "world units" : "grid steps";
}

void warnOfEmptySurface(const std::vector<float>& samples, double isovalue) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  warn(text("the surface is empty: samples range from %g to %g, the isovalue is %g", *low, *high,
            isovalue));
}

void warnOfFineBound(const LoadedVolume& volume, const EncodeArguments& arguments,
                     const Placement& placement) {
  const EncodeOptions& options = arguments.options;
  if (options.lossless) return;
  const double precision = precisionOf(volume.samples, volume.size[0], options.isovalue);
  if (options.maxError >= precision) return;
  warn(
      text("the bound of %.2g %s is finer than the data: the rounding of the samples has moved "
           "the surface by %.2g; a larger --max-error makes a smaller stream, --lossless keeps "
           "the samples as they are",
           boundInUnits(arguments, placement), unitOf(arguments),
           boundInUnits(arguments, placement) * precision / options.maxError));
}

/// Counts the surface of the source; of a sequence, that of the first frame.
Error countOnSource(const LoadedVolume& volume, double isovalue, const MeshOptions& options,
                    WorkReport& report) {
  Mesh mesh;
  Contours contours;
  const Error error =
      volume.dimension == 2   ? polygonize(volume.image(), isovalue, options, contours)
      : volume.dimension == 3 ? polygonize(volume.view(), isovalue, options, mesh)
                              : polygonize(volume.sequence(), isovalue, options, mesh);
  report.vertices = mesh.positions.size() / 3 + contours.points.size() / 2;
  report.triangles = mesh.indices.size() / 3;
  return error;
}

}  // namespace

std::string encodedLine(const EncodeArguments& arguments, const StreamInfo& info,
                        uint64_t sourceBytes) {
  const std::string source =
      arguments.source.volume.path + (sourceBytes ? " " + readableBytes(sourceBytes) : "");
  const std::string error =
      info.lossless
          ? "lossless"
          : text("error at most %g %s", boundInUnits(arguments, info.placement), unitOf(arguments));
  return text("%s -> %s %s, %llu vertices, %s", source.c_str(), arguments.output.c_str(),
              readableBytes(info.bytes).c_str(), static_cast<unsigned long long>(info.vertices),
              error.c_str());
}

void warnOfResult(const EncodeArguments& arguments, const LoadedVolume& volume,
                  const StreamInfo& info) {
  const EncodeOptions& options = arguments.options;
  if (info.vertices == 0)
    warnOfEmptySurface(volume.samples, options.isovalue);
  else
    warnOfFineBound(volume, arguments, info.placement);
  if (options.adaptive && options.preserveTopology)
    warn("--adaptive has no effect: streams with --preserve-topology have no coarse simplices");
  if (const std::string over = overLimits(info, Limits{}); !over.empty())
    warn(over + "; in a page and in programs that do not raise their limits it cannot be decoded");
}

void printReport(const EncodeArguments& arguments, const LoadedVolume& volume,
                 const StreamInfo& info, WorkReport report) {
  report.peakMemory = peakMemory();
  const Stopwatch polygonizing;
  const MeshOptions options{
      .polygonizer = arguments.options.polygonizer, .frame = Frame::Grid, .normals = false};
  if (const Error error = countOnSource(volume, arguments.options.isovalue, options, report);
      error != Error::None)
    throw Failure(arguments.source.volume.path, describe(error));
  report.polygonize = polygonizing.milliseconds();
  report.bytes = info.bytes;
  print(report);
}

}  // namespace isostar::native
