#include "cli/source_reader.h"

#include "cli/progress_bar.h"
#include "files/failure.h"
#include "mesh_io/mesh_file.h"
#include "model/model_volume.h"
#include "tetrahedra/grid_choice.h"
#include "tetrahedra/marching_tetrahedra.h"
#include "tetrahedra/tetrahedra_reader.h"
#include "tetrahedra/tetrahedra_volume.h"

namespace isostar::native {
namespace {

bool isModel(const SourceRequest& request) {
  return !request.volume.size && isMeshFile(request.volume.path);
}

LoadedVolume readModel(const SourceRequest& request) {
  const std::string& path = request.volume.path;
  const Mesh mesh = readMesh(path);
  ProgressBar bar("measuring distances");
  return modelVolume(mesh, path, request.grid.value_or(kModelGrid),
                     [&bar](double done) { bar.show(done); });
}

LoadedVolume readOnGrid(const SourceRequest& request) {
  const std::string& path = request.volume.path;
  const double isovalue = isovalueOf(request);
  const TetrahedralField field = readTetrahedralField(request);
  ProgressBar bar("sampling tetrahedra");
  return volumeOf(field, isosurfaceOf(field.mesh(), isovalue), isovalue, request.scalars,
                  chooseGrid(field, isovalue, request.grid, path),
                  [&bar](double done) { bar.show(done); })
      .volume;
}

}  // namespace

bool hasTetrahedra(const SourceRequest& request) {
  return !request.volume.size && isTetrahedral(request.volume.path);
}

TetrahedralField readTetrahedralField(const SourceRequest& request) {
  return TetrahedralField(readTetrahedra(request.volume.path, request.volume.choices.scalar));
}

void requireConsistent(const SourceRequest& request) {
  const VolumeRequest& volume = request.volume;
  if (volume.size.has_value() != volume.type.has_value())
    throw UsageFault("a raw volume needs both --size and --type");
  const bool model = isModel(request), tetrahedra = hasTetrahedra(request),
             mesh = model || tetrahedra;
  if (mesh && volume.spacing) throw UsageFault("--spacing is for volumes; use --grid for a mesh");
  if (mesh)
    requireUnderstood(volume.path, volume.choices, "a mesh", tetrahedra ? unsigned{kScalar} : 0);
  if (!mesh && request.grid) throw UsageFault("--grid is for meshes; a volume has a grid");
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
