// Computes the tables of cell_table.h when they are first used.
#include "surface/cell_table.h"

#include <algorithm>
#include <vector>

#include "util/cold_path.h"
#include "util/decodes_all.h"

namespace isostar {
namespace {

using Point = std::array<double, 3>;

bool positive(unsigned signs, unsigned corner) {
  return (signs >> corner & 1) != 0;
}

Point middle(const CellEdge& e) {
  Point p;
  for (unsigned a = 0; a < 3; ++a) p[a] = (e.axes >> a & 1) != 0 ? 0.5 : (e.corner >> a & 1);
  return p;
}

/// A segment of the surface on a face, from one crossing edge to another. Seen from outside the
/// cell its left side is positive, so that the polygon of such segments is counter-clockwise seen
/// from the negative side.
struct Segment {
  CellEdge from, to;
};

/// The edge between two corners of a cell.
CellEdge between(unsigned a, unsigned b) {
  return {static_cast<uint8_t>(a & b), static_cast<uint8_t>(a ^ b)};
}

/// A face's corners in counter-clockwise order, seen from outside the cell.
std::array<unsigned, 4> faceCorners(unsigned axis, bool far) {
  const unsigned u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3, base = far ? 1u << axis : 0u;
  std::array<unsigned, 4> corners{base, base | u, base | u | v, base | v};
  if (!far) std::swap(corners[1], corners[3]);
  return corners;
}

/// Cuts off each run of positive corners of a face by a segment of its own.
void cutFace(unsigned signs, const std::array<unsigned, 4>& corners,
             std::vector<Segment>& segments) {
  for (unsigned i = 0; i < 4; ++i) {
    if (positive(signs, corners[i]) || !positive(signs, corners[(i + 1) % 4])) continue;
    unsigned j = (i + 1) % 4;
    while (positive(signs, corners[(j + 1) % 4])) j = (j + 1) % 4;
    segments.push_back(
        {between(corners[i], corners[(i + 1) % 4]), between(corners[j], corners[(j + 1) % 4])});
  }
}

/// The faces of the cell on which an axis edge lies: bit axis * 2 + far.
unsigned facesOf(const CellEdge& e) {
  unsigned faces = 0;
  for (unsigned a = 0; a < 3; ++a) {
    if ((e.axes >> a & 1) == 0) faces |= 1u << (a * 2 + (e.corner >> a & 1));
  }
  return faces;
}

/// Cuts a polygon into triangles by ears, without a diagonal inside a face: it could coincide with
/// a diagonal of the next cell. False if that is not possible.
ISOSTAR_COLD bool cut(const std::vector<uint8_t>& polygon, CellCase& result) {
  const std::size_t n = polygon.size();
  if (n == 3) {
    result.add({polygon[0], polygon[1], polygon[2]});
    return true;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const uint8_t before = polygon[(i + n - 1) % n], ear = polygon[i], after = polygon[(i + 1) % n];
    if ((facesOf(result.edges[before]) & facesOf(result.edges[after])) != 0) continue;
    std::vector<uint8_t> rest = polygon;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    const uint8_t count = result.triangleCount;
    result.add({before, ear, after});
    if (cut(rest, result)) return true;
    result.triangleCount = count;
  }
  return false;
}

/// The segments of all faces form closed polygons, which are cut into triangles.
ISOSTAR_COLD CellCase cubesCase(unsigned signs) {
  std::vector<Segment> segments;
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (const bool far : {false, true}) cutFace(signs, faceCorners(axis, far), segments);
  }
  CellCase result;
  while (!segments.empty()) {
    std::vector<uint8_t> polygon;
    const CellEdge first = segments.back().from;
    CellEdge at = first;
    do {
      const auto next = std::find_if(segments.begin(), segments.end(),
                                     [&](const Segment& s) { return s.from == at; });
      polygon.push_back(result.number(at));
      at = next->to;
      segments.erase(next);
    } while (!(at == first));
    cut(polygon, result);
  }
  return result;
}

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
/// The determinant of three vectors.
double volume(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Adds one triangle, oriented so that the positive corner is behind it.
ISOSTAR_COLD void addTriangle(CellCase& result, std::array<CellEdge, 3> edges,
                              unsigned positiveCorner) {
  const Point corner{double(positiveCorner & 1), double(positiveCorner >> 1 & 1),
                     double(positiveCorner >> 2 & 1)};
  const Point a = middle(edges[0]), b = middle(edges[1]), c = middle(edges[2]);
  if (volume(minus(b, a), minus(c, a), minus(corner, a)) > 0) std::swap(edges[1], edges[2]);
  result.add({result.number(edges[0]), result.number(edges[1]), result.number(edges[2])});
}

ISOSTAR_COLD CellCase tetrahedraCase(unsigned signs, unsigned parity) {
  CellCase result;
  std::array<unsigned, 3> axes{0, 1, 2};
  do {
    // From the corner with even coordinates along one axis after the other (see Simplex).
    std::array<unsigned, 4> corner{parity, 0, 0, 0};
    for (unsigned i = 0; i < 3; ++i) corner[i + 1] = corner[i] ^ 1u << axes[i];
    std::vector<unsigned> above, below;
    for (unsigned c : corner) (positive(signs, c) ? above : below).push_back(c);
    if (above.size() == 1 || below.size() == 1) {
      const unsigned lone = above.size() == 1 ? above[0] : below[0];
      const auto& rest = above.size() == 1 ? below : above;
      addTriangle(result, {between(lone, rest[0]), between(lone, rest[1]), between(lone, rest[2])},
                  above[0]);
    } else if (above.size() == 2) {
      addTriangle(
          result,
          {between(above[0], below[0]), between(above[0], below[1]), between(above[1], below[1])},
          above[0]);
      addTriangle(
          result,
          {between(above[0], below[0]), between(above[1], below[1]), between(above[1], below[0])},
          above[1]);
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return result;
}

template <class MakeCase>
ISOSTAR_COLD CellTable tabulate(MakeCase makeCase) {
  CellTable table;
  for (unsigned signs = 0; signs < 256; ++signs) table[signs] = makeCase(signs);
  return table;
}

}  // namespace

ISOSTAR_COLD const CellTable& cellTable(Polygonizer polygonizer, unsigned parity) {
  if (!kDecodesAll || polygonizer == Polygonizer::Cubes) {
    static const CellTable kCubes = tabulate(cubesCase);
    return kCubes;
  }
  static const std::array<CellTable, 8> kTetrahedra = [] {
    std::array<CellTable, 8> tables;
    for (unsigned p = 0; p < 8; ++p)
      tables[p] = tabulate([p](unsigned signs) { return tetrahedraCase(signs, p); });
    return tables;
  }();
  return kTetrahedra[parity];
}

}  // namespace isostar
