#include "model/model_volume.h"

#include <algorithm>
#include <cmath>

#include "files/failure.h"
#include "files/text.h"
#include "measure/topology.h"
#include "model/distance_field.h"
#include "model/lost_part.h"
#include "model/welded_mesh.h"

namespace isostar::native {
namespace {

// Faces along the axes, which models of machines have, come to lie amid samples instead of on them.
constexpr double kMargin = 3.5;
constexpr double kWorthSaying = 0.001;  // of the area
constexpr double kMostSamples = 0x1p31;

struct Box {
  std::array<double, 3> low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  double extent(size_t axis) const { return high[axis] - low[axis]; }
};

Box boxOf(const Mesh& mesh) {
  Box box;
  for (uint32_t vertex : mesh.indices) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double x = mesh.positions[3 * size_t{vertex} + axis];
      box.low[axis] = std::min(box.low[axis], x);
      box.high[axis] = std::max(box.high[axis], x);
    }
  }
  return box;
}

CubicGrid gridAround(const Box& box, int samples, const std::string& path) {
  CubicGrid grid;
  grid.step = std::max({box.extent(0), box.extent(1), box.extent(2)}) / (samples - 1 - 2 * kMargin);
  if (!(grid.step > 0) || !std::isfinite(grid.step))
    throw Failure(path, "has no triangle with an area");
  for (size_t axis = 0; axis < 3; ++axis)
    grid.size[axis] =
        static_cast<int32_t>(std::ceil(box.extent(axis) / grid.step - 1e-9) + 1 + 2 * kMargin);
  grid.low = measure::Vector3{box.low[0], box.low[1], box.low[2]} -
             grid.step * measure::Vector3{kMargin, kMargin, kMargin};
  if (double(grid.size[0]) * grid.size[1] * grid.size[2] > kMostSamples)
    throw Failure(path, text("--grid %d makes %d x %d x %d samples; at most 2^31 can be encoded",
                             samples, grid.size[0], grid.size[1], grid.size[2]));
  return grid;
}

std::string counted(uint64_t count, const char* what) {
  return text("%llu %s%s", static_cast<unsigned long long>(count), what, count == 1 ? "" : "s");
}

/// All that is wrong, as one line; empty for a sound mesh.
std::string complaintOf(const WeldedMesh& welded) {
  const measure::Topology topology = measure::topologyOf(welded.mesh);
  std::string words;
  const auto add = [&words](const std::string& more) {
    words += (words.empty() ? "" : ", ") + more;
  };
  if (topology.boundaryEdges)
    add("not closed: " + counted(topology.boundaryEdges, "boundary edge"));
  if (topology.nonManifoldEdges)
    add(counted(topology.nonManifoldEdges, "edge") + " of more than two triangles");
  if (welded.degenerate) add(counted(welded.degenerate, "triangle") + " without area left out");
  if (welded.doubled) add(counted(welded.doubled, "doubled triangle") + " left out");
  if (topology.boundaryEdges || topology.nonManifoldEdges)
    words += "; inside is where most rays say so";
  return words;
}

}  // namespace

LoadedVolume modelVolume(const Mesh& mesh, const std::string& path, int grid,
                         const std::function<void(double)>& progress) {
  if (mesh.indices.empty()) throw Failure(path, "has no triangles");
  const WeldedMesh welded = weld(mesh);
  if (welded.mesh.indices.empty()) throw Failure(path, "has no triangle with an area");
  const CubicGrid cubes = gridAround(boxOf(welded.mesh), grid, path);
  LoadedVolume volume;
  volume.samples = distanceField(welded.mesh, cubes, progress);
  volume.size = cubes.size;
  volume.placement.origin = {cubes.low.x, cubes.low.y, cubes.low.z};
  volume.placement.spacing = {cubes.step, cubes.step, cubes.step};
  if (const std::string complaint = complaintOf(welded); !complaint.empty())
    volume.remarks.push_back(complaint);
  if (const double lost = lostPart(welded.mesh, cubes, volume.samples); lost > kWorthSaying)
    volume.remarks.push_back(
        text("%.2g %% of the surface bounds parts too thin for --grid %d", 100 * lost, grid));
  return volume;
}

}  // namespace isostar::native
