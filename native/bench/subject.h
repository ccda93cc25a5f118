#pragma once

#include <optional>
#include <string>

#include "isostar/isostar.h"
#include "volume/loaded_volume.h"

namespace isostar::bench {

/// The command line's description of a subject: a file, or "synthetic:NAME".
struct SubjectRequest {
  std::string path;
  std::optional<double> isovalue;  // none: that of the synthetic field, or Otsu's threshold
  int effort = 1;                  // of isostar's encoder
};

/// An isosurface that all codecs encode.
struct Subject {
  native::LoadedVolume volume;
  double isovalue = 0;
  int effort = 1;
  Mesh mesh;  // the source's marching cubes mesh in grid steps, without normals
};

Subject readSubject(const SubjectRequest&);

/// The marching cubes mesh of the source, which is the input of the mesh codecs. Throws a Failure.
Mesh marchingCubes(const native::LoadedVolume&, double isovalue);

/// Converts sample indices to grid steps along the smallest spacing, the unit of all distances in
/// the comparison.
void toGridSteps(Mesh&, const Placement&);

/// Throws a Failure if a call of the codec has failed.
void require(Error, const char* what);

}  // namespace isostar::bench
