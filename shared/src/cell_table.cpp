#include "cell_table.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace isostar {
namespace {

using Point = std::array<double, 3>;

bool positive(unsigned signs, unsigned corner) { return (signs >> corner & 1) != 0; }

Point middle(const CellEdge& e) {
  Point p;
  for (unsigned a = 0; a < 3; ++a) p[a] = (e.axes >> a & 1) != 0 ? 0.5 : (e.corner >> a & 1);
  return p;
}

uint8_t place(std::vector<CellEdge>& edges, CellEdge e) {
  auto at = std::find(edges.begin(), edges.end(), e);
  if (at == edges.end()) at = edges.insert(edges.end(), e);
  return static_cast<uint8_t>(at - edges.begin());
}

/// A segment of the surface on a face, from one crossed edge to another, positive side on its left seen from outside.
struct Segment {
  CellEdge from, to;
};

/// The axis edge between two corners of a cell.
CellEdge between(unsigned a, unsigned b) { return {static_cast<uint8_t>(a & b), static_cast<uint8_t>(a ^ b)}; }

/// A face's corners in counter-clockwise order, seen from outside the cell.
std::array<unsigned, 4> faceCorners(unsigned axis, bool far) {
  const unsigned u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3, base = far ? 1u << axis : 0u;
  std::array<unsigned, 4> corners{base, base | u, base | u | v, base | v};
  if (!far) std::swap(corners[1], corners[3]);
  return corners;
}

/// Each positive run of a face's corners is cut off by a segment of its own.
void cutFace(unsigned signs, const std::array<unsigned, 4>& corners, std::vector<Segment>& segments) {
  for (unsigned i = 0; i < 4; ++i) {
    if (positive(signs, corners[i]) || !positive(signs, corners[(i + 1) % 4])) continue;
    unsigned j = (i + 1) % 4;
    while (positive(signs, corners[(j + 1) % 4])) j = (j + 1) % 4;
    segments.push_back({between(corners[i], corners[(i + 1) % 4]), between(corners[j], corners[(j + 1) % 4])});
  }
}

/// The faces of the cell that an axis edge lies on, as bits axis * 2 + far.
unsigned facesOf(const CellEdge& e) {
  unsigned faces = 0;
  for (unsigned a = 0; a < 3; ++a) {
    if ((e.axes >> a & 1) == 0) faces |= 1u << (a * 2 + (e.corner >> a & 1));
  }
  return faces;
}

/// Cuts a polygon into triangles without a diagonal inside a face: such a one would meet its like in the next cell.
bool cut(const std::vector<uint8_t>& polygon, const std::vector<CellEdge>& edges, std::vector<std::array<uint8_t, 3>>& out) {
  const std::size_t n = polygon.size();
  if (n == 3) {
    out.push_back({polygon[0], polygon[1], polygon[2]});
    return true;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const uint8_t before = polygon[(i + n - 1) % n], ear = polygon[i], after = polygon[(i + 1) % n];
    if ((facesOf(edges[before]) & facesOf(edges[after])) != 0) continue;
    std::vector<uint8_t> rest = polygon;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    const std::size_t size = out.size();
    out.push_back({before, ear, after});
    if (cut(rest, edges, out)) return true;
    out.resize(size);
  }
  return false;
}

CellCase cubesCase(unsigned signs) {
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
      const auto next = std::find_if(segments.begin(), segments.end(), [&](const Segment& s) { return s.from == at; });
      polygon.push_back(place(result.edges, at));
      at = next->to;
      segments.erase(next);
    } while (!(at == first));
    // The segments keep the positive side on their left seen from outside; seen from the negative side the polygon
    // they bound inside the cell then turns clockwise.
    std::reverse(polygon.begin(), polygon.end());
    cut(polygon, result.edges, result.triangles);
  }
  return result;
}

/// The edge of the RBMT between two corners of a cell.
CellEdge rbmtEdge(unsigned a, unsigned b) { return {static_cast<uint8_t>(a & b), static_cast<uint8_t>(a ^ b)}; }

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double volume(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// One triangle, turned so that the positive corner is behind it.
void addTriangle(CellCase& result, std::array<CellEdge, 3> edges, unsigned positiveCorner) {
  const Point corner{double(positiveCorner & 1), double(positiveCorner >> 1 & 1), double(positiveCorner >> 2 & 1)};
  const Point a = middle(edges[0]), b = middle(edges[1]), c = middle(edges[2]);
  if (volume(minus(b, a), minus(c, a), minus(corner, a)) > 0) std::swap(edges[1], edges[2]);
  result.triangles.push_back({place(result.edges, edges[0]), place(result.edges, edges[1]), place(result.edges, edges[2])});
}

CellCase tetrahedraCase(unsigned signs, unsigned parity) {
  CellCase result;
  std::array<unsigned, 3> axes{0, 1, 2};
  do {
    // From the corner with even coordinates, one axis after the other (see Simplex).
    std::array<unsigned, 4> corner{parity, 0, 0, 0};
    for (unsigned i = 0; i < 3; ++i) corner[i + 1] = corner[i] ^ 1u << axes[i];
    std::vector<unsigned> above, below;
    for (unsigned c : corner) (positive(signs, c) ? above : below).push_back(c);
    if (above.size() == 1 || below.size() == 1) {
      const unsigned lone = above.size() == 1 ? above[0] : below[0];
      const auto& rest = above.size() == 1 ? below : above;
      addTriangle(result, {rbmtEdge(lone, rest[0]), rbmtEdge(lone, rest[1]), rbmtEdge(lone, rest[2])}, above[0]);
    } else if (above.size() == 2) {
      addTriangle(result, {rbmtEdge(above[0], below[0]), rbmtEdge(above[0], below[1]), rbmtEdge(above[1], below[1])}, above[0]);
      addTriangle(result, {rbmtEdge(above[0], below[0]), rbmtEdge(above[1], below[1]), rbmtEdge(above[1], below[0])}, above[1]);
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return result;
}

std::array<CellTable, 9> allTables() {
  std::array<CellTable, 9> tables;
  for (unsigned signs = 0; signs < 256; ++signs) {
    tables[8][signs] = cubesCase(signs);
    for (unsigned parity = 0; parity < 8; ++parity) tables[parity][signs] = tetrahedraCase(signs, parity);
  }
  return tables;
}

}  // namespace

const CellTable& cellTable(Polygonizer polygonizer, unsigned parity) {
  static const std::array<CellTable, 9> kTables = allTables();
  return kTables[polygonizer == Polygonizer::Cubes ? 8 : parity];
}

}  // namespace isostar
