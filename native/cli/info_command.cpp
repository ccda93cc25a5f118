#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "cli/stream_file.h"
#include "files/input_file.h"
#include "files/text.h"
#include "volume/placement.h"

namespace isostar::native {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::string input;
  Units units = Units::Grid;
  bool json = false;
};

struct Bits {
  uint64_t connectivity = 0, geometry = 0, header = 0;
};

/// The bits of all layers, or of the first isovalue's only.
Bits bitsOf(const StreamInfo& info, bool all) {
  Bits bits{.header = 8 * info.headerBytes};
  for (const LayerInfo& layer : info.layers)
    if (all || layer.isovalue == 0)
      (layer.kind == "geometry" ? bits.geometry : bits.connectivity) += 8 * layer.bytes;
  return bits;
}

const char* nameOf(Polygonizer polygonizer) {
  return polygonizer == Polygonizer::Cubes ? "cubes" : "tetrahedra";
}

void printJson(const StreamInfo& info, double unit) {
  const Bits bits = bitsOf(info, true);
  Json layers = Json::array();
  for (const LayerInfo& layer : info.layers) {
    layers.push_back({{"kind", layer.kind},
                      {"level", layer.level},
                      {"offset", layer.offset},
                      {"bytes", layer.bytes},
                      {"error", layer.error * unit},
                      {"isovalue", info.isovalues[static_cast<size_t>(layer.isovalue)]}});
  }
  const Json json = {
      {"format", info.version},
      {"dimension", info.dimension},
      {"isovalues", info.isovalues},
      {"size", info.size},
      {"frames", info.frames},
      {"spacing", info.placement.spacing},
      {"origin", info.placement.origin},
      {"direction", info.placement.direction},
      {"polygonizer", nameOf(info.polygonizer)},
      {"lossless", info.lossless},
      {"adaptive", info.adaptive},
      {"preservesTopology", info.preservesTopology},
      {"effort", info.effort},
      {"trimmed", info.trimmed},
      {"chunk", info.chunkSide},
      {"maxError", info.maxError * unit},
      {"bytes", info.bytes},
      {"vertices", info.vertices},
      {"bits",
       {{"connectivity", bits.connectivity}, {"geometry", bits.geometry}, {"header", bits.header}}},
      {"layers", layers}};
  std::cout << json.dump(2) << "\n";
}

std::string triple(const auto& values) {
  return text("%g x %g x %g", static_cast<double>(values[0]), static_cast<double>(values[1]),
              static_cast<double>(values[2]));
}

void printHead(const StreamInfo& info, const Arguments& arguments, double unit) {
  const Placement& placement = info.placement;
  const auto line = [](const char* what, const std::string& value) {
    std::cout << text("%-12s %s\n", what, value.c_str());
  };
  line("stream", text("%s, %s, format %d", printable(arguments.input).c_str(),
                      readableBytes(info.bytes).c_str(), info.version));
  line("grid", info.dimension == 2   ? text("%d x %d, an image", info.size[0], info.size[1])
               : info.dimension == 4 ? triple(info.size) + text(", %d frames", info.frames)
                                     : triple(info.size));
  line("spacing", triple(placement.spacing));
  line("origin", text("%g, %g, %g", placement.origin[0], placement.origin[1], placement.origin[2]));
  const auto& d = placement.direction;
  line("direction",
       text("%g %g %g, %g %g %g, %g %g %g", d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7], d[8]));
  for (double isovalue : info.isovalues) line("isovalue", text("%.9g", isovalue));
  line("vertices", text("%llu", static_cast<unsigned long long>(info.vertices)));
  line("error", info.lossless ? text("lossless, %s", nameOf(info.polygonizer))
                              : text("at most %g %s, %s", info.maxError * unit,
                                     arguments.units == Units::World ? "world units" : "grid steps",
                                     nameOf(info.polygonizer)) +
                                    (info.adaptive ? ", adaptive" : ""));
  if (info.effort > 1) line("effort", text("%d, which takes longer to decode", info.effort));
  if (info.chunkSide != 0) line("chunks", text("of %d cells a side", info.chunkSide));
  if (info.trimmed) line("domain", "ends inside the grid, where the surface is trimmed");
  if (info.preservesTopology) line("topology", "the same in every layer");
}

void printBits(const StreamInfo& info) {
  if (info.vertices == 0) return;
  const Bits bits = bitsOf(info, false);
  const double vertices = static_cast<double>(info.vertices);
  std::cout << text("%-12s connectivity %.3f, geometry %.3f, header %.3f bits per vertex\n", "bits",
                    static_cast<double>(bits.connectivity) / vertices,
                    static_cast<double>(bits.geometry) / vertices,
                    static_cast<double>(bits.header) / vertices);
}

void printLayers(const StreamInfo& info, double unit) {
  const bool several = info.isovalues.size() > 1;
  std::cout << text("\n%-12s %5s %12s %12s %12s%s\n", "layer", "level", "complete at", "bytes",
                    "RMS error", several ? "     isovalue" : "");
  for (const LayerInfo& layer : info.layers) {
    std::cout << text("%-12s %5d %12llu %12llu %12.4g", layer.kind.c_str(), layer.level,
                      static_cast<unsigned long long>(layer.offset),
                      static_cast<unsigned long long>(layer.bytes), layer.error * unit);
    if (several) std::cout << text(" %12.9g", info.isovalues[static_cast<size_t>(layer.isovalue)]);
    std::cout << "\n";
  }
}

void run(const Arguments& arguments) {
  const std::vector<std::byte> stream = readFile(arguments.input);
  const StreamInfo info = inspectStream(stream, arguments.input);
  const double unit = arguments.units == Units::World ? smallestSpacing(info.placement) : 1;
  if (stream.size() < info.bytes)
    warn(text("%s holds %zu of %llu bytes", arguments.input.c_str(), stream.size(),
              static_cast<unsigned long long>(info.bytes)));
  if (arguments.json) return printJson(info, unit);
  printHead(info, arguments, unit);
  printBits(info);
  printLayers(info, unit);
}

}  // namespace

void addInfo(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("info", "Show the contents of a stream, layer by layer");
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("input", arguments->input, "The stream, IN.isostar; - for standard input")
      ->required();
  addUnits(command, arguments->units,
           "The unit of errors: steps of the grid's smallest spacing, or the world's unit");
  command.add_flag("--json", arguments->json, "Print JSON");
  command.callback([arguments] { run(*arguments); });
}

}  // namespace isostar::native
