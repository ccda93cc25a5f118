#include "cli/source.h"

#include "cli/progress_bar.h"
#include "files/failure.h"
#include "files/text.h"
#include "measure/surface_distance.h"
#include "mesh_io/mesh_file.h"
#include "model/model_volume.h"
#include "tetrahedra/formats.h"
#include "tetrahedra/grid_over.h"
#include "tetrahedra/marching_tetrahedra.h"
#include "tetrahedra/resample.h"
#include "tetrahedra/tetrahedral_field.h"
#include "volume/placement.h"

namespace isostar::native {
namespace {

bool isModel(const SourceRequest& request) {
  return !request.volume.size && isMeshFile(request.volume.path);
}

LoadedVolume readModel(const SourceRequest& request) {
  const std::string& path = request.volume.path;
  const Mesh mesh = readMesh(path);
  ProgressBar bar("measuring distances");
  return modelVolume(mesh, path, request.grid.value_or(kModelGrid), [&bar](double done) { bar.show(done); });
}

bool hasTetrahedra(const SourceRequest& request) {
  return !request.volume.size && isTetrahedral(request.volume.path);
}

/// How well the samples show the tetrahedra's isosurface; the encoder's own bound counts from the samples.
std::string remarkOnSampling(const LoadedVolume& volume, const TetrahedralField& field, double isovalue) {
  Mesh surface;
  if (polygonize(volume.view(), isovalue, {.normals = false}, surface) != Error::None) return {};
  const auto distance = measure::surfaceDistance(surface, isosurfaceOf(field.mesh(), isovalue));
  if (!distance) return {};
  const double step = smallestSpacing(volume.placement);
  return text("sampled at %d x %d x %d points, up to %.2g grid steps from the tetrahedra's isosurface (RMS %.2g)",
              volume.size[0], volume.size[1], volume.size[2], distance->symmetric().max / step,
              distance->symmetric().rms / step);
}

LoadedVolume readOnGrid(const SourceRequest& request) {
  const std::string& path = request.volume.path;
  const TetrahedralField field(readTetrahedra(path, request.scalar));
  const SampleGrid grid = gridOver(field, isovalueOf(request), request.grid, path);
  ProgressBar bar("sampling tetrahedra");
  LoadedVolume volume;
  ResampledField sampled = resample(field, grid, [&bar](double done) { bar.show(done); });
  volume.samples = std::move(sampled.samples);
  volume.domain = std::move(sampled.domain);
  volume.size = grid.size;
  volume.placement.origin = {grid.low.x, grid.low.y, grid.low.z};
  volume.placement.spacing = {grid.steps.x, grid.steps.y, grid.steps.z};
  volume.remarks = field.mesh().remarks;
  if (const std::string remark = remarkOnSampling(volume, field, isovalueOf(request)); !remark.empty())
    volume.remarks.push_back(remark);
  return volume;
}

}  // namespace

void requireSense(const SourceRequest& request) {
  const VolumeRequest& volume = request.volume;
  if (volume.size.has_value() != volume.type.has_value()) throw UsageFault("a raw volume needs both --size and --type");
  const bool model = isModel(request), tetrahedra = hasTetrahedra(request), mesh = model || tetrahedra;
  if (mesh && volume.spacing) throw UsageFault("--spacing is for volumes; a mesh takes --grid");
  if (!mesh && request.grid) throw UsageFault("--grid is for meshes; a volume has a grid");
  if (!tetrahedra && request.scalar) throw UsageFault("--scalar is for tetrahedral meshes");
  if (!model && !request.isovalue) throw UsageFault("--iso is required; see isostar encode --help");
}

double isovalueOf(const SourceRequest& request) {
  return request.isovalue.value_or(0);
}

LoadedVolume readSource(const SourceRequest& request) {
  if (isModel(request)) return readModel(request);
  return hasTetrahedra(request) ? readOnGrid(request) : readVolume(request.volume);
}

}  // namespace isostar::native
