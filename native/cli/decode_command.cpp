#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "cli/stopwatch.h"
#include "cli/stream_file.h"
#include "cli/work_report.h"
#include "files/failure.h"
#include "files/input_file.h"
#include "files/output_file.h"
#include "files/text.h"
#include "mesh_io/mesh_file.h"
#include "mesh_io/svg_writer.h"

namespace isostar::native {
namespace {

struct Arguments {
  std::string input, output;
  std::optional<uint64_t> bytes;
  std::optional<int> level;
  std::optional<double> time;
  std::optional<Region> region;
  MeshOptions options;
  bool json = false;
};

/// The start of the first layer above the requested level.
size_t endOfLevel(const StreamInfo& info, int level, size_t whole) {
  uint64_t end = info.headerBytes;
  for (const LayerInfo& layer : info.layers) {
    if (layer.level > level) return std::min<size_t>(end, whole);
    end = layer.offset;
  }
  return whole;
}

/// The end of the last layer that the requested isovalue depends on. It does not depend on further
/// isovalues, which are coded later.
size_t endOfIsovalue(const StreamInfo& info, double isovalue, size_t whole) {
  const auto& held = info.isovalues;
  const auto wanted = std::find(held.begin(), held.end(), isovalue) - held.begin();
  for (size_t i = 1; i < info.layers.size(); ++i) {
    if (info.layers[i].isovalue > wanted) return std::min<size_t>(info.layers[i - 1].offset, whole);
  }
  return whole;
}

size_t prefixLength(const Arguments& arguments, std::span<const std::byte> stream) {
  if (arguments.bytes) return std::min<uint64_t>(*arguments.bytes, stream.size());
  if (arguments.level)
    return endOfLevel(inspectStream(stream, arguments.input), *arguments.level, stream.size());
  const StreamInfo info = inspectStream(stream, arguments.input);
  return endOfIsovalue(info, arguments.options.isovalue.value_or(info.isovalues[0]), stream.size());
}

/// Warns of a file that ends early: it holds `held` bytes.
void warnOfMissingBytes(const Arguments& arguments, const Decoder& decoder, uint64_t held) {
  const std::string surface = decoder.level() < 0
                                  ? "they hold no surface yet"
                                  : text("the surface is of level %d, the finest is %d",
                                         decoder.level(), decoder.levels() - 1);
  warn(text("%s ends early: it has %llu of %llu bytes; %s", arguments.input.c_str(),
            static_cast<unsigned long long>(held),
            static_cast<unsigned long long>(decoder.info().bytes), surface.c_str()));
}

/// Warns of a prefix that ends inside a layer which is damaged: its first bytes cannot be checked,
/// but those of the file can.
void warnOfDamage(const Arguments& arguments, std::span<const std::byte> stream, size_t length,
                  const Decoder& decoder) {
  const StreamInfo& info = decoder.info();
  const uint64_t whole = info.layers.empty() ? info.headerBytes : info.layers.back().offset;
  if (!arguments.bytes || decoder.bytes() <= whole || length >= stream.size()) return;
  if (isDamaged(stream, length))
    warn(
        text("%s is damaged in the layer in which the first %zu bytes end; the surface may be "
             "wrong",
             arguments.input.c_str(), length));
}

bool isDrawing(const std::string& path) {
  return extensionOf(path) == ".svg";
}

/// The output must be a drawing for an image and a mesh for all others. --time must be within a
/// sequence.
void requireSuitable(const Arguments& arguments, const StreamInfo& info) {
  const bool image = info.dimension == 2;
  if (image != isDrawing(arguments.output))
    throw Failure(arguments.input,
                  image ? "holds an image's contours, which are written as .svg"
                        : "holds a surface, which is written as .ply, .obj, .stl or .glb");
  if (!arguments.time) return;
  if (info.dimension != 4)
    throw Failure(arguments.input, "is not a sequence; --time is for sequences");
  if (*arguments.time < 0 || *arguments.time > info.frames - 1)
    throw Failure(arguments.input, text("has frames 0 to %d; there is no time %g", info.frames - 1,
                                        *arguments.time));
}

std::string decodedLine(const Arguments& arguments, const WorkReport& report,
                        const Decoder& decoder) {
  std::error_code ignored;
  const uintmax_t written = std::filesystem::file_size(arguments.output, ignored);
  const std::string triangles =
      decoder.info().dimension == 2
          ? ""
          : text(" %llu triangles,", static_cast<unsigned long long>(report.triangles));
  const std::string error = decoder.level() < 0
                                ? "no surface yet"
                                : text("RMS error %.3g grid steps", decoder.rmsError());
  return text("%s %s -> %s %s, %llu vertices,%s %s", arguments.input.c_str(),
              readableBytes(report.bytes).c_str(), arguments.output.c_str(),
              ignored ? "" : readableBytes(written).c_str(),
              static_cast<unsigned long long>(report.vertices), triangles.c_str(), error.c_str());
}

void writeSurface(const Arguments& arguments, const Decoder& decoder, WorkReport& report) {
  const Stopwatch polygonizing;
  MeshOptions options = arguments.options;
  options.time = arguments.time.value_or(0);
  options.normals = storesNormals(arguments.output);
  const Mesh mesh = surfaceOf(decoder, options, arguments.input);
  report.polygonize = polygonizing.milliseconds();
  report.peakMemory = peakMemory();
  const Stopwatch writing;
  writeMesh(mesh, arguments.output);
  report.io += writing.milliseconds();
  report.vertices = mesh.positions.size() / 3;
  report.triangles = mesh.indices.size() / 3;
}

void writeDrawing(const Arguments& arguments, const Decoder& decoder, WorkReport& report) {
  const Stopwatch tracing;
  Contours contours;
  if (const Error error = decoder.contours(arguments.options, contours); error != Error::None)
    throw Failure(arguments.input, describe(error));
  report.polygonize = tracing.milliseconds();
  report.peakMemory = peakMemory();
  const Stopwatch writing;
  writeSvg(contours, decoder.info(), arguments.options.frame, arguments.output);
  report.io += writing.milliseconds();
  report.vertices = contours.points.size() / 2;
}

/// Decodes the whole stream or the prefix that is asked for.
Decoder decodePrefix(const Arguments& arguments, WorkReport& report) {
  const Stopwatch reading;
  const std::vector<std::byte> stream = readFile(arguments.input);
  report.io = reading.milliseconds();
  const Stopwatch decoding;
  const size_t length = prefixLength(arguments, stream);
  Decoder decoder = decodeStream(std::span(stream).first(length), arguments.input);
  report.codec = decoding.milliseconds();
  report.bytes = length;
  const bool asked = arguments.bytes || arguments.level;
  if (!asked && stream.size() < decoder.info().bytes)
    warnOfMissingBytes(arguments, decoder, stream.size());
  warnOfDamage(arguments, stream, length, decoder);
  return decoder;
}

/// Decodes what the region takes.
Decoder decodePart(const Arguments& arguments, WorkReport& report) {
  if (!isRegularFile(arguments.input))
    throw Failure(arguments.input, "is not a file; --region reads parts of files only");
  Region region = *arguments.region;
  region.frame = arguments.options.frame;
  const Stopwatch decoding;
  Decoder decoder = decodeRegion(arguments.input, region, report.bytes, report.io);
  report.codec = decoding.milliseconds() - report.io;
  if (decoder.info().chunkSide == 0)
    warn(text("--region has no effect: %s is not in chunks", arguments.input.c_str()));
  if (decoder.error() == Error::Truncated)
    warnOfMissingBytes(arguments, decoder, fileSize(arguments.input));
  return decoder;
}

void run(const Arguments& arguments) {
  if (!isMeshFile(arguments.output) && !isDrawing(arguments.output))
    throw UsageFault(text("%s must end in .ply, .obj, .stl or .glb, or in .svg for an image",
                          arguments.output.c_str()));
  if (arguments.json && isStandardOutput(arguments.output))
    throw UsageFault("--json and the mesh cannot share standard output");
  requireDifferent(arguments.input, arguments.output);
  requireWritable(arguments.output);

  WorkReport report{.work = "decode"};
  const Decoder decoder =
      arguments.region ? decodePart(arguments, report) : decodePrefix(arguments, report);
  requireIsovalue(arguments.options.isovalue, decoder.info(), arguments.input);
  requireSuitable(arguments, decoder.info());
  if (decoder.info().dimension == 2) {
    writeDrawing(arguments, decoder, report);
  } else {
    writeSurface(arguments, decoder, report);
  }
  if (arguments.json) print(report);
  printMessage(decodedLine(arguments, report, decoder));
}

}  // namespace

void addDecode(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("decode", "Decode a stream, or the first part of one, to a mesh");
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("input", arguments->input, "The stream, IN.isostar; - for standard input")
      ->required();
  command
      .add_option(
          "output", arguments->output,
          "The mesh to write: .ply, .obj, .stl or .glb; the drawing of an image's contours: .svg")
      ->required();
  auto* bytes = command.add_option("--bytes", arguments->bytes, "Decode the first N bytes only")
                    ->type_name("N")
                    ->check(kWhole);
  auto* level = command
                    .add_option("--level", arguments->level,
                                "Stop before the first layer above level L, 0 being the coarsest")
                    ->type_name("L")
                    ->check(kWhole)
                    ->excludes(bytes);
  addRegion(command, arguments->region,
            "Decode a box, in the frame of --frame, at full precision and the rest coarsely; reads "
            "only what that takes. A stream that is not in chunks is decoded whole")
      ->excludes(bytes)
      ->excludes(level);
  command
      .add_option("--iso", arguments->options.isovalue,
                  "One of the stream's isovalues (default: the first one), or a value between two "
                  "of them, interpolated from the decoded scalars")
      ->check(kFinite)
      ->type_name("V");
  command
      .add_option("--time", arguments->time,
                  "The time of a sequence's surface, in frames from 0 [default: 0]")
      ->check(kFinite)
      ->type_name("T");
  addThreads(command);
  addPolygonizer(command, arguments->options.polygonizer,
                 "One vertex per crossing axis edge, or one polygon per crossing tetrahedron");
  addFrame(command, arguments->options.frame,
           "Apply spacing, origin and direction, or put sample (i,j,k) at (i,j,k)");
  command.add_flag("--json", arguments->json, "Print sizes and times to standard output");
  command.callback([arguments] { run(*arguments); });
}

}  // namespace isostar::native
