#include "model/model_volume.h"

#include <algorithm>
#include <cmath>

#include "files/failure.h"
#include "files/text.h"
#include "measure/mesh_topology.h"
#include "model/distance_field.h"
#include "model/lost_area.h"
#include "model/welded_mesh.h"

namespace isostar::native {
namespace {

/// Grid steps around the model. Faces along the axes, typical of machine parts, then lie halfway
/// between samples.
constexpr double kMargin = 3.5;
constexpr double kReportedLoss = 0.001;  // as a fraction of the area
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

SampleGrid gridAround(const Box& box, int samples, const std::string& path) {
  SampleGrid grid;
  const double step =
      std::max({box.extent(0), box.extent(1), box.extent(2)}) / (samples - 1 - 2 * kMargin);
  if (!(step > 0) || !std::isfinite(step)) throw Failure(path, "has no triangle with an area");
  grid.steps = {step, step, step};
  for (size_t axis = 0; axis < 3; ++axis)
    grid.size[axis] =
        static_cast<int32_t>(std::ceil(box.extent(axis) / step - 1e-9) + 1 + 2 * kMargin);
  grid.low = measure::Vector3{box.low[0], box.low[1], box.low[2]} -
             step * measure::Vector3{kMargin, kMargin, kMargin};
  if (double(grid.size[0]) * grid.size[1] * grid.size[2] > kMostSamples)
    throw Failure(path, text("--grid %d makes %d x %d x %d samples; at most 2^31 can be encoded",
                             samples, grid.size[0], grid.size[1], grid.size[2]));
  return grid;
}

std::string counted(uint64_t count, const char* what) {
  return text("%llu %s%s", static_cast<unsigned long long>(count), what, count == 1 ? "" : "s");
}

/// All defects of a mesh in one line; empty if there are none.
std::string defectsOf(const WeldedMesh& welded) {
  const measure::Topology topology = measure::topologyOf(welded.mesh);
  std::string defects;
  const auto add = [&defects](const std::string& more) {
    defects += (defects.empty() ? "" : ", ") + more;
  };
  if (topology.boundaryEdges)
    add("not closed: " + counted(topology.boundaryEdges, "boundary edge"));
  if (topology.nonManifoldEdges)
    add(counted(topology.nonManifoldEdges, "edge") + " of more than two triangles");
  if (welded.degenerate) add(counted(welded.degenerate, "triangle") + " without area left out");
  if (welded.doubled) add(counted(welded.doubled, "doubled triangle") + " left out");
  if (topology.boundaryEdges || topology.nonManifoldEdges)
    defects += "; a majority vote of rays decides what is inside";
  return defects;
}

}  // namespace

LoadedVolume modelVolume(const Mesh& mesh, const std::string& path, int grid,
                         const std::function<void(double)>& progress) {
  if (mesh.indices.empty()) throw Failure(path, "has no triangles");
  const WeldedMesh welded = weld(mesh);
  if (welded.mesh.indices.empty()) throw Failure(path, "has no triangle with an area");
  const SampleGrid cubes = gridAround(boxOf(welded.mesh), grid, path);
  LoadedVolume volume;
  volume.samples = distanceField(welded.mesh, cubes, progress);
  volume.size = cubes.size;
  volume.placement.origin = {cubes.low.x, cubes.low.y, cubes.low.z};
  volume.placement.spacing = {cubes.steps.x, cubes.steps.y, cubes.steps.z};
  if (const std::string defects = defectsOf(welded); !defects.empty())
    volume.remarks.push_back(defects);
  if (const double lost = lostAreaFraction(welded.mesh, cubes, volume.samples);
      lost > kReportedLoss)
    volume.remarks.push_back(text(
        "%.2g %% of the surface bounds parts that are too thin for --grid %d", 100 * lost, grid));
  return volume;
}

}  // namespace isostar::native
