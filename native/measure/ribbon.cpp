#include "measure/ribbon.h"

namespace isostar::measure {

Mesh ribbon(const Contours& contours, float width) {
  Mesh mesh;
  for (std::size_t i = 0; i + 1 < contours.points.size(); i += 2)
    for (const float z : {0.0f, width})
      mesh.positions.insert(mesh.positions.end(), {contours.points[i], contours.points[i + 1], z});
  const auto extrude = [&mesh](uint32_t from, uint32_t to) {
    const uint32_t a = 2 * from, b = 2 * to;
    mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
  };
  for (std::size_t line = 0; line + 1 < contours.starts.size(); ++line) {
    const uint32_t first = contours.starts[line], end = contours.starts[line + 1];
    for (uint32_t i = first; i + 1 < end; ++i) extrude(i, i + 1);
    if (line >= contours.open && end > first) extrude(end - 1, first);
  }
  return mesh;
}

}  // namespace isostar::measure
