#include "bench/subject.h"

#include "bench/otsu.h"
#include "bench/synthetic_field.h"
#include "files/failure.h"
#include "volume/placement.h"
#include "volume/volume_reader.h"

namespace isostar::bench {
namespace {

constexpr std::string_view kSynthetic = "synthetic:";

Subject readField(const SubjectRequest& request) {
  const std::string& path = request.path;
  if (!path.starts_with(kSynthetic)) {
    Subject subject{.volume = native::readVolume({.path = path}),
                    .isovalue = 0,
                    .effort = request.effort,
                    .mesh = {}};
    subject.isovalue = request.isovalue ? *request.isovalue : otsuThreshold(subject.volume.samples);
    return subject;
  }
  SyntheticField field = syntheticField(path.substr(kSynthetic.size()));
  return {.volume = std::move(field.volume),
          .isovalue = request.isovalue.value_or(field.isovalue),
          .effort = request.effort,
          .mesh = {}};
}

}  // namespace

Subject readSubject(const SubjectRequest& request) {
  Subject subject = readField(request);
  subject.mesh = marchingCubes(subject.volume, subject.isovalue);
  return subject;
}

Mesh marchingCubes(const native::LoadedVolume& volume, double isovalue) {
  Mesh mesh;
  require(polygonize(volume.view(), isovalue, {.frame = Frame::Grid, .normals = false}, mesh),
          "polygonize");
  toGridSteps(mesh, volume.placement);
  return mesh;
}

void toGridSteps(Mesh& mesh, const Placement& placement) {
  const double smallest = native::smallestSpacing(placement);
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] =
        static_cast<float>(mesh.positions[i] * (placement.spacing[i % 3] / smallest));
}

void require(Error error, const char* what) {
  if (error != Error::None) throw native::Failure(what, describe(error));
}

}  // namespace isostar::bench
