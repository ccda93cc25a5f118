#include <CLI/CLI.hpp>
#include <array>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "cli/stream_file.h"
#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "measure/mesh_topology.h"
#include "measure/surface_distance.h"
#include "mesh_io/mesh_file.h"
#include "tetrahedra/marching_tetrahedra.h"
#include "tetrahedra/tetrahedra_distance.h"
#include "tetrahedra/tetrahedra_reader.h"
#include "volume/placement.h"

namespace isostar::native {
namespace {

using Json = nlohmann::ordered_json;
using measure::Distance;
using measure::SurfaceDistance;
using measure::Topology;

struct Arguments {
  std::array<std::string, 2> paths;
  MeshOptions options{.normals = false};
  std::optional<std::string> scalar;
  std::optional<Units> units;
  bool json = false;
};

struct Surface {
  Mesh mesh;
  std::optional<double> step{};  // the grid step in the mesh's coordinates; a mesh file has none
  std::unique_ptr<TetrahedralField> source{};  // the tetrahedra whose isosurface the mesh is
  bool trimmed = false;                        // the stream ends at the boundary of its domain
};

Surface loadTetrahedra(const std::string& path, const Arguments& arguments) {
  const auto& isovalue = arguments.options.isovalue;
  if (!isovalue) throw UsageFault(path + " needs --iso");
  auto field = std::make_unique<TetrahedralField>(readTetrahedra(path, arguments.scalar));
  for (const std::string& remark : field->mesh().remarks) warn(path + ": " + remark);
  Mesh isosurface = isosurfaceOf(field->mesh(), *isovalue);
  return {.mesh = std::move(isosurface), .source = std::move(field)};
}

Surface load(const std::string& path, const Arguments& arguments) {
  const MeshOptions& options = arguments.options;
  if (isTetrahedral(path)) return loadTetrahedra(path, arguments);
  if (isMeshFile(path)) return {.mesh = readMesh(path)};
  const Decoder decoder = decodeStream(readFile(path), path);
  requireIsovalue(options.isovalue, decoder.info(), path);
  const double step = options.frame == Frame::World ? smallestSpacing(decoder.info().placement) : 1;
  return {
      .mesh = surfaceOf(decoder, options, path), .step = step, .trimmed = decoder.info().trimmed};
}

std::optional<SurfaceDistance> distanceBetween(const Surface& a, const Surface& b) {
  if (a.trimmed || b.trimmed) return measure::surfaceDistance(a.mesh, b.mesh);
  if (a.source && !b.source) {
    const auto distance = distanceToTetrahedra(b.mesh, *a.source, a.mesh);
    return distance ? std::optional(SurfaceDistance{distance->bToA, distance->aToB}) : std::nullopt;
  }
  return b.source && !a.source ? distanceToTetrahedra(a.mesh, *b.source, b.mesh)
                               : measure::surfaceDistance(a.mesh, b.mesh);
}

/// The length of the report's unit in units of the coordinates.
double unitOf(const Arguments& arguments, const std::array<Surface, 2>& surfaces, Units& units) {
  const auto step = surfaces[0].step ? surfaces[0].step : surfaces[1].step;
  units = arguments.units.value_or(step ? Units::Grid : Units::World);
  if (units == Units::World) return 1;
  if (!step) throw UsageFault("--units grid needs a stream: a mesh file has no grid");
  return *step;
}

Json json(const Distance& distance, double unit) {
  return {
      {"mean", distance.mean / unit}, {"rms", distance.rms / unit}, {"max", distance.max / unit}};
}

Json json(const std::string& path, const Topology& topology) {
  Json genus;
  if (topology.genus()) genus = *topology.genus();
  return {{"file", path},
          {"vertices", topology.vertices},
          {"triangles", topology.triangles},
          {"components", topology.components},
          {"euler", topology.euler()},
          {"genus", genus},
          {"boundaryEdges", topology.boundaryEdges},
          {"boundaryLoops", topology.boundaryLoops},
          {"nonManifoldEdges", topology.nonManifoldEdges},
          {"misorientedEdges", topology.misorientedEdges}};
}

void printJson(const Arguments& arguments, const std::array<Topology, 2>& topologies,
               const std::optional<SurfaceDistance>& distance, double unit, Units units) {
  Json report = {{"units", units == Units::Grid ? "grid" : "world"},
                 {"a", json(arguments.paths[0], topologies[0])},
                 {"b", json(arguments.paths[1], topologies[1])},
                 {"aToB", nullptr},
                 {"bToA", nullptr},
                 {"symmetric", nullptr}};
  if (distance) {
    report["aToB"] = json(distance->aToB, unit);
    report["bToA"] = json(distance->bToA, unit);
    report["symmetric"] = json(distance->symmetric(), unit);
  }
  std::cout << report.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

void printDistance(const char* which, const Distance& distance, double unit) {
  std::cout << text("%-10s mean %-12.6g RMS %-12.6g max %.6g\n", which, distance.mean / unit,
                    distance.rms / unit, distance.max / unit);
}

void printTopology(const std::string& path, const Topology& t) {
  const auto genus = t.genus();
  std::cout << text(
      "%s: %llu vertices, %llu triangles, %llu components, Euler characteristic %lld, genus %s, "
      "%llu boundary edges in %llu loops",
      printable(path).c_str(), static_cast<unsigned long long>(t.vertices),
      static_cast<unsigned long long>(t.triangles), static_cast<unsigned long long>(t.components),
      static_cast<long long>(t.euler()), genus ? std::to_string(*genus).c_str() : "undefined",
      static_cast<unsigned long long>(t.boundaryEdges),
      static_cast<unsigned long long>(t.boundaryLoops));
  if (t.nonManifoldEdges)
    std::cout << ", " << t.nonManifoldEdges << " edges of more than two triangles";
  if (t.misorientedEdges)
    std::cout << ", " << t.misorientedEdges << " edges of oppositely oriented triangles";
  std::cout << "\n";
}

void run(const Arguments& arguments) {
  const std::array<Surface, 2> surfaces = {load(arguments.paths[0], arguments),
                                           load(arguments.paths[1], arguments)};
  Units units{};
  const double unit = unitOf(arguments, surfaces, units);
  const std::array<Topology, 2> topologies = {measure::topologyOf(surfaces[0].mesh),
                                              measure::topologyOf(surfaces[1].mesh)};
  const auto distance = distanceBetween(surfaces[0], surfaces[1]);
  if (arguments.json) return printJson(arguments, topologies, distance, unit, units);
  for (size_t i = 0; i < 2; ++i) printTopology(arguments.paths[i], topologies[i]);
  if (!distance) {
    std::cout << "no distance: a surface has no triangles\n";
    return;
  }
  std::cout << (units == Units::Grid ? "distance in grid steps\n"
                                     : "distance in the unit of the coordinates\n");
  printDistance("A to B", distance->aToB, unit);
  printDistance("B to A", distance->bToA, unit);
  printDistance("symmetric", distance->symmetric(), unit);
}

}  // namespace

void addCompare(CLI::App& app) {
  CLI::App& command = *app.add_subcommand(
      "compare", "Measure the distance between two surfaces, and their topology");
  const auto arguments = std::make_shared<Arguments>();
  command
      .add_option("a", arguments->paths[0],
                  "A mesh (.ply, .obj, .stl, .glb), a stream, or tetrahedra (.vtu, .vtk). Of "
                  "tetrahedra the isosurface is compared, with the part of the other surface "
                  "inside their domain, unless that is a stream trimmed to the domain")
      ->required();
  command.add_option("b", arguments->paths[1], "The other surface")->required();
  command
      .add_option("--iso", arguments->options.isovalue,
                  "The isovalue of tetrahedra, and of streams with several")
      ->check(kFinite);
  command
      .add_option("--scalar", arguments->scalar,
                  "The name of the tetrahedra's scalar; default: the active or first one")
      ->option_text("NAME");
  addPolygonizer(command, arguments->options.polygonizer, "How streams become meshes");
  addFrame(command, arguments->options.frame,
           "Coordinates of streams: in the world, or with sample (i,j,k) at (i,j,k)");
  addUnits(command, arguments->units,
           "The unit of distances: grid steps (default with a stream) or the coordinates' unit");
  command.add_flag("--json", arguments->json, "Print JSON");
  command.callback([arguments] { run(*arguments); });
}

}  // namespace isostar::native
