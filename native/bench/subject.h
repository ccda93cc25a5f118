#pragma once

#include <optional>
#include <string>

#include "isostar/isostar.h"
#include "volume/loaded_volume.h"

namespace isostar::bench {

/// What the command line names: a file, or "synthetic:NAME".
struct SubjectRequest {
  std::string path;
  std::optional<double> isovalue;  // none: the field's own, or Otsu's threshold
  int effort = 1;                  // of isostar's encoder
};

/// One isosurface that all codecs have to carry.
struct Subject {
  native::LoadedVolume volume;
  double isovalue = 0;
  int effort = 1;
  Mesh mesh;  // marching cubes' of the source, in grid steps, without normals
};

Subject readSubject(const SubjectRequest&);

/// Marching cubes on the source, as the competitors' encoders need it. Fails with one line.
Mesh marchingCubes(const native::LoadedVolume&, double isovalue);

/// Sample indices to grid steps along the smallest spacing: the unit of every distance in the
/// comparison.
void toGridSteps(Mesh&, const Placement&);

/// Ends the program's work with one line where a call of the codec fails.
void require(Error, const char* what);

}  // namespace isostar::bench
