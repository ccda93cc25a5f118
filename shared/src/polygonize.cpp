#include "field.h"
#include "isostar/isostar.h"
#include "octave.h"
#include "polygonizer.h"
#include "tube.h"

namespace isostar {

Error polygonize(const Volume& volume, double isovalue, const MeshOptions& options, Mesh& out) {
  if (!invertible(volume.placement) || !sensible<3>(volume.samples, volume.size, isovalue)) return Error::BadArgument;
  const GridField<3> field(volume.samples, volume.size, isovalue);
  const auto signs = field.signs(1);
  Header header;
  header.isovalue = isovalue;
  header.lossless = true;
  header.polygonizer = options.polygonizer;
  field.quantize(header, signs);
  const auto active = activeBricks(signs);
  Scalars<3> scalars(active.size());
  Tube<3> tube;
  for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
    if (members == Members::DiagonalEnds && options.polygonizer == Polygonizer::Cubes) break;
    for (std::size_t place = 0; place < active.size(); ++place) {
      if (active[place] == 0) continue;
      tube.enter(signs, place, members);
      if (tube.empty()) continue;
      auto& brick = scalars.writable(place);
      tube.forEach([&](int row, std::size_t r, int x) {
        brick.set(r * kBrickSide + static_cast<std::size_t>(x), tube.positive(row, x), field.magnitude(header, place, r, x), 0);
      });
    }
  }
  return polygonize({signs, scalars, 2 * header.positiveOffset - 1, 2 * header.negativeOffset - 1, volume.placement}, options, UINT32_MAX, out);
}

}  // namespace isostar
