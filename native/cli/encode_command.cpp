#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/encode_report.h"
#include "cli/messages.h"
#include "cli/progress_bar.h"
#include "cli/stopwatch.h"
#include "cli/verified_encoding.h"
#include "cli/volume_options.h"
#include "files/failure.h"
#include "files/output_file.h"
#include "files/text.h"
#include "model/model_volume.h"
#include "tetrahedra/bounded_encoding.h"
#include "volume/named_files.h"
#include "volume/placement.h"

namespace isostar::native {
namespace {

void writeWhole(const std::vector<std::byte>& bytes, const std::string& path) {
  OutputFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

/// Rejects options that the source's dimension does not support.
void requireDimension(const LoadedVolume& volume, const EncodeOptions& options,
                      const std::string& path) {
  if (options.preserveTopology && volume.dimension != 3)
    throw Failure(path, text("--preserve-topology is for volumes only; this is %s",
                             volume.dimension == 2 ? "an image" : "a sequence"));
  if (options.adaptive && volume.dimension == 4)
    throw Failure(path, "is a sequence; --adaptive is not for sequences");
}

/// The largest ratio of spacings between axes. The search for the nearest vertex takes time in
/// proportion to it.
constexpr double kMostUneven = 1e4;

void requireEvenSpacing(const LoadedVolume& volume, const std::string& path) {
  const auto& spacing = volume.placement.spacing;
  const auto [least, most] =
      std::minmax_element(spacing.begin(), spacing.begin() + std::min(3, volume.dimension));
  if (*most > kMostUneven * *least)
    throw Failure(path, text("has spacings from %g to %g; one may be at most %g times another",
                             *least, *most, kMostUneven));
}

/// All isovalues must be different. Adaptive streams have no further ones.
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

/// Whether the stream codes the domain: those with further isovalues or --preserve-topology do not.
bool codesDomain(const EncodeOptions& options) {
  return options.furtherIsovalues.empty() && !options.preserveTopology;
}

void dropDomain(LoadedVolume& volume) {
  if (volume.domain.empty()) return;
  volume.domain.clear();
  volume.remarks.push_back(
      "with --near or --preserve-topology the surface continues beyond the mesh's boundary, to its "
      "bounding box");
}

struct Encoded {
  LoadedVolume volume;
  std::vector<std::byte> stream;
};

void warnOfRemarks(const EncodeArguments& arguments, const LoadedVolume& volume) {
  for (const std::string& remark : volume.remarks)
    warn(arguments.source.volume.path + ": " + remark);
}

Encoded encodeSamples(EncodeArguments& arguments, WorkReport& report) {
  EncodeOptions& options = arguments.options;
  if (!codesDomain(options)) arguments.source.scalars = Scalars::Field;
  const Stopwatch reading;
  LoadedVolume volume = readSource(arguments.source);
  report.io = reading.milliseconds();
  requireDimension(volume, options, arguments.source.volume.path);
  requireEvenSpacing(volume, arguments.source.volume.path);
  if (!codesDomain(options)) dropDomain(volume);
  warnOfRemarks(arguments, volume);
  if (arguments.units == Units::World) options.maxError /= smallestSpacing(volume.placement);
  const Stopwatch encoding;
  std::vector<std::byte> stream = encodeVerified(volume, options, arguments.source.volume.path);
  report.codec = encoding.milliseconds();
  return {std::move(volume), std::move(stream)};
}

/// In world units the bound is relative to the tetrahedra themselves, for which the grid is made
/// fine enough, unless --grid fixes it.
bool isBoundToTetrahedra(const EncodeArguments& arguments) {
  return hasTetrahedra(arguments.source) && arguments.units == Units::World &&
         !arguments.source.grid && !arguments.options.lossless && codesDomain(arguments.options);
}

Encoded encodeTetrahedra(EncodeArguments& arguments, WorkReport& report) {
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

/// The output must be none of the files that are read.
void requireUnread(const std::string& input, const std::string& output) {
  requireDifferent(input, output);
  for (const std::string& file : filesReadWith(input)) {
    if (isSameFile(file, output))
      throw Failure(output, text("is the input too: it is read with %s", input.c_str()));
  }
}

void run(EncodeArguments& arguments) {
  requireConsistent(arguments.source);
  arguments.options.isovalue = isovalueOf(arguments.source);
  requireDistinct(arguments.options);
  if (arguments.json && isStandardOutput(arguments.output))
    throw UsageFault("--json and the stream cannot share standard output");
  requireUnread(arguments.source.volume.path, arguments.output);
  requireWritable(arguments.output);
  const uint64_t sourceBytes = bytesReadWith(arguments.source.volume.path);

  WorkReport report{.work = "encode"};
  const auto [volume, stream] = isBoundToTetrahedra(arguments) ? encodeTetrahedra(arguments, report)
                                                               : encodeSamples(arguments, report);

  const Stopwatch writing;
  writeWhole(stream, arguments.output);
  report.io += writing.milliseconds();

  StreamInfo info;
  if (const Error error = inspect(stream, info); error != Error::None)
    throw Failure(arguments.output, describe(error));
  // The header states what was measured where that is more than was asked.
  if (!info.lossless && !isBoundToTetrahedra(arguments) &&
      info.maxError > arguments.options.maxError) {
    warn(text("the bound of %g grid steps cannot be held; the stream holds %g",
              arguments.options.maxError, info.maxError));
    arguments.options.maxError = info.maxError;
  }
  warnOfResult(arguments, volume, info);
  if (arguments.json) printReport(arguments, volume, info, report);
  printMessage(encodedLine(arguments, info, sourceBytes));
}

void addFiles(CLI::App& command, EncodeArguments& arguments) {
  command
      .add_option("volume", arguments.source.volume.path,
                  "A volume: NRRD, MetaImage, NIfTI, TIFF, VTK image, a folder of DICOM or TIFF "
                  "slices, or raw samples; a fourth axis is time. "
                  "An image: .png, .jpg, or .tif with one page; colours become luminance, 8-bit "
                  "samples 0 ... 1. "
                  "Tetrahedra: .vtu, .vtk. "
                  "A closed mesh: .ply, .obj, .stl, .glb, converted to distances in grid steps, "
                  "positive inside, up to 4")
      ->required();
  command
      .add_option("output", arguments.output,
                  "The stream to write, OUT.isostar; - for standard output")
      ->required();
}

void addSource(CLI::App& command, EncodeArguments& arguments) {
  command
      .add_option("--iso", arguments.source.isovalue,
                  "The isovalue; samples above it are positive (inside); 0 for a closed mesh")
      ->check(kFinite);
  addFurther(command, arguments.options.furtherIsovalues,
             "Further isovalues, coded on top of the first one");
  command
      .add_option("--grid", arguments.source.grid,
                  text("Samples along the longest axis, for a mesh [default: %d; for tetrahedra "
                       "by their size]",
                       kModelGrid))
      ->check(CLI::Range(kSmallestModelGrid, kLargestModelGrid));
}

void addCoding(CLI::App& command, EncodeArguments& arguments) {
  EncodeOptions& options = arguments.options;
  auto* bound = command
                    .add_option("--max-error", options.maxError,
                                "The bound on the two-sided distance between the decoded surface "
                                "and the source's")
                    ->check(kPositive);
  command
      .add_flag("--lossless", options.lossless,
                "Decode to the surface that the polygonizer makes of the source: exactly where "
                "samples are whole numbers, else within 2^-14 grid steps")
      ->excludes(bound);
  command
      .add_flag("--adaptive", options.adaptive,
                "Coarser simplices where they keep the bound, if that makes the stream smaller; "
                "not for sequences")
      ->excludes("--lossless");
  command.add_flag("--preserve-topology", options.preserveTopology,
                   "Every surface along the stream has the components and handles of the last "
                   "one; volumes only");
  command
      .add_option("--effort", options.effort,
                  "2 makes streams smaller, those of smooth surfaces by up to 18 %; encoding and "
                  "decoding take longer")
      ->check(CLI::Range(1, EncodeOptions::kMostEffort));
  addChunk(command, options.chunkSide,
           "The side of the chunks that are decoded side by side, in cells: 64, 128 or none "
           "[default: 128 from 200,000 vertices on]. No effect on images, sequences, and with "
           "--near, --adaptive or --preserve-topology");
  addThreads(command);
  command.add_flag("--best-effort", options.bestEffort,
                   "Write a stream even if the bound cannot be held; it then states the bound that "
                   "it holds");
  addPolygonizer(command, options.polygonizer, "The surface for which the bound holds");
}

void addFormat(CLI::App& command, EncodeArguments& arguments) {
  addUnits(command, arguments.units,
           "The unit of lengths: steps of the grid's smallest spacing, or the world's unit. In "
           "world units and without --grid, the bound of tetrahedra is relative to the "
           "tetrahedra instead of to samples");
  addVolume(command, arguments.source.volume);
  command.add_flag("--json", arguments.json, "Print sizes and times to standard output");
}

}  // namespace

void addEncode(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("encode",
                                          "Compress the isosurface of a volume or of tetrahedra, "
                                          "the contours of an image, or a closed mesh");
  const auto arguments = std::make_shared<EncodeArguments>();
  addFiles(command, *arguments);
  addSource(command, *arguments);
  addCoding(command, *arguments);
  addFormat(command, *arguments);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace isostar::native
