#include "cli/source.h"

#include "cli/progress_bar.h"
#include "files/failure.h"
#include "mesh_io/mesh_file.h"
#include "model/model_volume.h"

namespace isostar::native {
namespace {

bool isModel(const SourceRequest& request) {
  return !request.volume.size && canReadMesh(request.volume.path);
}

LoadedVolume readModel(const SourceRequest& request) {
  const std::string& path = request.volume.path;
  const Mesh mesh = readMesh(path);
  ProgressBar bar("measuring distances");
  return modelVolume(mesh, path, request.grid.value_or(kModelGrid), [&bar](double done) { bar.show(done); });
}

}  // namespace

void requireSense(const SourceRequest& request) {
  const VolumeRequest& volume = request.volume;
  if (volume.size.has_value() != volume.type.has_value()) throw UsageFault("a raw volume needs both --size and --type");
  if (isModel(request) && volume.spacing) throw UsageFault("--spacing is for volumes; a mesh takes --grid");
  if (!isModel(request) && request.grid) throw UsageFault("--grid is for meshes; a volume has a grid");
  if (!isModel(request) && !request.isovalue) throw UsageFault("--iso is required; see isostar encode --help");
}

double isovalueOf(const SourceRequest& request) {
  return request.isovalue.value_or(0);
}

LoadedVolume readSource(const SourceRequest& request) {
  return isModel(request) ? readModel(request) : readVolume(request.volume);
}

}  // namespace isostar::native
