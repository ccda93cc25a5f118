#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/choices.h"
#include "cli/commands.h"
#include "cli/progress_bar.h"
#include "cli/source.h"
#include "cli/words.h"
#include "cli/work_report.h"
#include "files/failure.h"
#include "files/output_file.h"
#include "files/text.h"
#include "model/model_volume.h"
#include "tetrahedra/bounded_encoding.h"
#include "volume/placement.h"
#include "volume/precision.h"

namespace isostar::native {
namespace {

struct Arguments {
  SourceRequest source;
  std::string output;
  EncodeOptions options;
  Units units = Units::Grid;
  bool json = false;
};

/// The file's or the folder's length; 0 for a header whose samples lie elsewhere.
uint64_t sourceBytes(const std::string& path) {
  const std::string extension = extensionOf(path);
  if (extension == ".nhdr" || extension == ".mhd" || extension == ".hdr") return 0;
  if (!std::filesystem::is_directory(path)) return std::filesystem::file_size(path);
  uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  return bytes;
}

void writeWhole(const std::vector<std::byte>& bytes, const std::string& path) {
  OutputFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

/// The bound as the user counts lengths.
double boundInUnits(const Arguments& arguments, const Placement& placement) {
  const double bound = arguments.options.maxError;
  return arguments.units == Units::World ? bound * smallestSpacing(placement) : bound;
}

std::string closingLine(const Arguments& arguments, const StreamInfo& info) {
  const uint64_t before = sourceBytes(arguments.source.volume.path);
  const std::string source =
      arguments.source.volume.path + (before ? " " + readableBytes(before) : "");
  const std::string error =
      info.lossless ? "lossless"
                    : text("error at most %g %s", boundInUnits(arguments, info.placement),
                           arguments.units == Units::World ? "world units" : "grid steps");
  return text("%s -> %s %s, %llu vertices, %s", source.c_str(), arguments.output.c_str(),
              readableBytes(info.bytes).c_str(), static_cast<unsigned long long>(info.vertices),
              error.c_str());
}

void warnOfEmptySurface(const std::vector<float>& samples, double isovalue) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  warn(text("the surface is empty: the samples reach from %g to %g, the isovalue is %g", *low,
            *high, isovalue));
}

void warnOfFineBound(const LoadedVolume& volume, const EncodeOptions& options) {
  if (options.lossless) return;
  const double precision = precisionOf(volume.samples, volume.size[0], options.isovalue);
  if (options.maxError >= precision) return;
  warn(
      text("the bound, %.2g grid steps, is finer than the data: the rounding of samples moves the "
           "surface by %.2g; --lossless keeps all that they tell",
           options.maxError, precision));
}

/// Of a sequence its first frame counts.
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

/// Counted on the source itself, after peak memory and times have been taken.
void printReport(const Arguments& arguments, const LoadedVolume& volume, const StreamInfo& info,
                 WorkReport report) {
  report.peakMemory = peakMemory();
  const Stopwatch polygonizing;
  const MeshOptions options{arguments.options.polygonizer, Frame::Grid, false};
  if (const Error error = countOnSource(volume, arguments.options.isovalue, options, report);
      error != Error::None)
    throw Failure(arguments.source.volume.path, describe(error));
  report.polygonize = polygonizing.milliseconds();
  report.bytes = info.bytes;
  print(report);
}

/// Some options are for volumes alone.
void requireDimension(const LoadedVolume& volume, const EncodeOptions& options,
                      const std::string& path) {
  if (options.preserveTopology && volume.dimension != 3)
    throw Failure(path, text("--preserve-topology is for volumes only; this is %s",
                             volume.dimension == 2 ? "an image" : "a sequence"));
  if (options.adaptive && volume.dimension == 4)
    throw Failure(path, "--adaptive is not for sequences; this is one");
}

std::vector<std::byte> encodeWithBar(const LoadedVolume& volume, EncodeOptions options,
                                     const std::string& path) {
  ProgressBar bar("encoding");
  options.progress = [&bar](double done) { bar.show(done); };
  std::vector<std::byte> stream;
  const Error error = volume.dimension == 2   ? encode(volume.image(), options, stream)
                      : volume.dimension == 3 ? encode(volume.view(), options, stream)
                                              : encode(volume.sequence(), options, stream);
  if (error != Error::None) throw Failure(path, describe(error));
  return stream;
}

/// Further isovalues are none of those given before; adaptive streams have none.
void requireDistinct(const EncodeOptions& options) {
  if (options.adaptive && !options.furtherIsovalues.empty())
    throw UsageFault("--near and --adaptive do not go together");
  std::vector<double> all = options.furtherIsovalues;
  all.push_back(options.isovalue);
  std::sort(all.begin(), all.end());
  const auto twice = std::adjacent_find(all.begin(), all.end());
  if (twice == all.end()) return;
  if (*twice == options.isovalue)
    throw UsageFault(text("--near %g is the isovalue itself", *twice));
  throw UsageFault(text("--near names %g twice", *twice));
}

/// Streams of several isovalues, and those of one topology, do not tell where a domain ends.
bool endsAtDomain(const EncodeOptions& options) {
  return options.furtherIsovalues.empty() && !options.preserveTopology;
}

void leaveDomain(LoadedVolume& volume) {
  if (volume.domain.empty()) return;
  volume.domain.clear();
  volume.remarks.push_back(
      "with --near or --preserve-topology the surface goes on beyond the mesh's boundary, to the "
      "box around it");
}

struct Encoded {
  LoadedVolume volume;
  std::vector<std::byte> stream;
};

void warnOfRemarks(const Arguments& arguments, const LoadedVolume& volume) {
  for (const std::string& remark : volume.remarks)
    warn(arguments.source.volume.path + ": " + remark);
}

Encoded encodeSamples(Arguments& arguments, WorkReport& report) {
  EncodeOptions& options = arguments.options;
  if (!endsAtDomain(options)) arguments.source.scalars = Scalars::Field;
  const Stopwatch reading;
  LoadedVolume volume = readSource(arguments.source);
  report.io = reading.milliseconds();
  requireDimension(volume, options, arguments.source.volume.path);
  if (!endsAtDomain(options)) leaveDomain(volume);
  warnOfRemarks(arguments, volume);
  if (arguments.units == Units::World) options.maxError /= smallestSpacing(volume.placement);
  const Stopwatch encoding;
  std::vector<std::byte> stream = encodeWithBar(volume, options, arguments.source.volume.path);
  report.codec = encoding.milliseconds();
  return {std::move(volume), std::move(stream)};
}

/// In the world a bound can hold for the tetrahedra themselves: the grid is as fine as that takes,
/// unless the user names it.
bool boundCountsFromTetrahedra(const Arguments& arguments) {
  return hasTetrahedra(arguments.source) && arguments.units == Units::World &&
         !arguments.source.grid && !arguments.options.lossless && endsAtDomain(arguments.options);
}

Encoded encodeTetrahedra(Arguments& arguments, WorkReport& report) {
  EncodeOptions& options = arguments.options;
  const Stopwatch reading;
  const TetrahedralField field = readTetrahedralField(arguments.source);
  report.io = reading.milliseconds();
  const Stopwatch encoding;
  ProgressBar bar("sampling tetrahedra");
  BoundedStream made = encodeWithin(options.maxError, field, options, arguments.source.volume.path,
                                    [&bar](double done) { bar.show(done); });
  report.codec = encoding.milliseconds();
  warnOfRemarks(arguments, made.volume);
  options.maxError =
      std::max(options.maxError, made.distance) / smallestSpacing(made.volume.placement);
  return {std::move(made.volume), std::move(made.stream)};
}

void run(Arguments& arguments) {
  requireSense(arguments.source);
  arguments.options.isovalue = isovalueOf(arguments.source);
  requireDistinct(arguments.options);
  if (arguments.json && arguments.output == "-")
    throw UsageFault("--json and the stream cannot share standard output");
  requireDifferent(arguments.source.volume.path, arguments.output);
  requireWritable(arguments.output);

  WorkReport report{.work = "encode"};
  const auto [volume, stream] = boundCountsFromTetrahedra(arguments)
                                    ? encodeTetrahedra(arguments, report)
                                    : encodeSamples(arguments, report);
  const EncodeOptions& options = arguments.options;

  const Stopwatch writing;
  writeWhole(stream, arguments.output);
  report.io += writing.milliseconds();

  StreamInfo info;
  if (const Error error = inspect(stream, info); error != Error::None)
    throw Failure(arguments.output, describe(error));
  if (info.vertices == 0)
    warnOfEmptySurface(volume.samples, options.isovalue);
  else
    warnOfFineBound(volume, options);
  if (options.adaptive && options.preserveTopology)
    warn("--adaptive: streams with --preserve-topology have no coarse simplices in the end");
  if (arguments.json) printReport(arguments, volume, info, report);
  say(closingLine(arguments, info));
}

}  // namespace

void addEncode(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("encode",
                                          "Compress the isosurface of a volume or of tetrahedra, "
                                          "the contours of an image, or a closed mesh");
  const auto arguments = std::make_shared<Arguments>();
  EncodeOptions& options = arguments->options;
  VolumeRequest& volume = arguments->source.volume;
  command
      .add_option("volume", volume.path,
                  "NRRD, MetaImage, NIfTI, TIFF, VTK image, a folder of DICOM or TIFF slices, raw "
                  "samples, a fourth axis being time; "
                  "an image (.png, .jpg, .tif of one page; colours become luminance, 8 bits 0 ... "
                  "1); tetrahedra (.vtu, .vtk); "
                  "or a closed mesh (.ply, .obj, .stl, .glb): its distances in grid steps, "
                  "positive inside, up to 4")
      ->required();
  command
      .add_option("output", arguments->output,
                  "The stream to write, OUT.isostar; - for standard output")
      ->required();
  command
      .add_option("--iso", arguments->source.isovalue,
                  "The isovalue; samples above it are inside; 0 for a mesh")
      ->check(kFinite);
  addFurther(command, options.furtherIsovalues,
             "Further isovalues close by, which reuse what the first one tells");
  command
      .add_option("--scalar", arguments->source.scalar,
                  "Which scalar of a tetrahedral mesh; else the marked or first")
      ->option_text("NAME");
  command
      .add_option("--grid", arguments->source.grid,
                  text("Samples along the longest axis, for a mesh [default: %d; for tetrahedra by "
                       "their size]",
                       kModelGrid))
      ->check(CLI::Range(kSmallestModelGrid, kLargestModelGrid));
  auto* bound = command
                    .add_option("--max-error", options.maxError,
                                "Farthest that the decoded surface and the source's may be apart")
                    ->check(kPositive);
  command
      .add_flag("--lossless", options.lossless, "Keep the polygonizer's own surface of the source")
      ->excludes(bound);
  command
      .add_flag("--adaptive", options.adaptive,
                "Coarser simplices where they keep the bound, if that makes the file smaller; not "
                "for sequences")
      ->excludes("--lossless");
  command.add_flag("--preserve-topology", options.preserveTopology,
                   "Show no surface on the way that has other components or handles than the last "
                   "one; volumes only");
  command
      .add_option("--effort", options.effort,
                  "2 makes streams smaller, smooth surfaces' by up to 18 %, and takes longer to "
                  "encode and to decode")
      ->check(CLI::Range(1, EncodeOptions::kMostEffort));
  addPolygonizer(command, options.polygonizer, "The surface that the bound holds for");
  addUnits(command, arguments->units,
           "What lengths count: steps of the grid's smallest spacing, or the world's unit; then, "
           "without --grid, "
           "the bound of tetrahedra counts from themselves instead of from samples");
  addSize(command, volume.size,
          "Samples along each axis of a raw volume, x fastest, little endian");
  addSampleType(command, volume.type, "Sample type of a raw volume");
  addSpacing(command, volume.spacing, "Distance of samples, overruling the file's");
  command.add_flag("--json", arguments->json, "Print sizes and times to standard output");
  command.callback([arguments] { run(*arguments); });
}

}  // namespace isostar::native
