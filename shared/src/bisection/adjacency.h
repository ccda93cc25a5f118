// The neighbour of a simplex across a face, and its parent (§4.3), in closed form and in integers.
#pragma once

#include <optional>

#include "bisection/tagged_simplex.h"

namespace isostar {

/// A neighbour across a face. `newVertex`: the index of its vertex that is not on the face.
template <int D>
struct Adjacent {
  TaggedSimplex<D> simplex;
  int newVertex;
};

/// The simplex of the same depth on the other side of the face opposite vertex i; nothing where the
/// box ends.
template <int D>
std::optional<Adjacent<D>> across(const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& s, int i) {
  Adjacent<D> other{s, i};
  auto& v = other.simplex.vertices;
  const int path = s.tag;
  // x + y - z: the fourth corner of a parallelogram, or the mirror image of z if x equals y.
  const auto corner = [](const Coordinates<D>& x, const Coordinates<D>& y,
                         const Coordinates<D>& z) {
    Coordinates<D> w;
    for (int a = 0; a < D; ++a) w[a] = x[a] + y[a] - z[a];
    return w;
  };
  const auto centre = [&](int j) { return j == path ? s.middle() : s.vertices[j]; };
  other.simplex.mirrored = !s.mirrored;
  // Outwards on two axes in the other order, or on the last one to the other side.
  if (i > path) {
    v[i] = corner(centre(i - 1), i < D ? v[i + 1] : centre(i - 1), v[i]);
  } else if (i > 0 && i < path) {  // two steps of the path in the other order
    v[i] = corner(v[i - 1], v[i + 1], v[i]);
  } else if (path == D) {  // the neighbouring cell
    const auto& next = v[i == 0 ? 1 : D - 1];
    v[i] = corner(next, next, v[i]);
  } else {
    // The rest of the path lies in two sides of the cube around vertex path + 1. In the other side
    // it continues along that vertex's axis, at its beginning or at its end, so that it leads from
    // an even corner to an odd one.
    const auto m = s.middle(), &out = s.vertices[path + 1];
    int axis = 0;
    while (m[axis] == out[axis]) ++axis;
    const int32_t step = 2 * (out[axis] - m[axis]);
    const bool behind = m[axis] / step % 2 == 0;
    if (i == 0 && behind)
      std::copy(s.vertices.begin() + 1, s.vertices.begin() + path + 1, v.begin());
    if (i != 0 && !behind) std::copy(s.vertices.begin(), s.vertices.begin() + path, v.begin() + 1);
    other.newVertex = behind ? path : 0;
    v[other.newVertex] = behind ? v[path - 1] : v[1];
    v[other.newVertex][axis] += step;
    if (other.newVertex != i && path % 2 != 0) other.simplex.mirrored = s.mirrored;
  }
  for (int a = 0; a < D; ++a) {
    const auto beyond = [&](const Coordinates<D>& w) { return w[a] >= hierarchy.box()[a]; };
    if (v[other.newVertex][a] < 0 || std::all_of(v.begin(), v.end(), beyond)) return std::nullopt;
  }
  return other;
}

/// The index of the vertex that the last bisection created. The simplex must not be of the base.
template <int D>
int newest(const TaggedSimplex<D>& s) {
  return s.tag == D ? 1 : s.tag + 1;
}

/// The simplex whose bisection created this one, which must not be of the base.
template <int D>
TaggedSimplex<D> parent(const TaggedSimplex<D>& s) {
  TaggedSimplex<D> p = s;
  p.tag = newest(s);
  --p.depth;
  const auto &m = s.vertices[p.tag], &first = s.vertices[0], &last = s.vertices[p.tag - 1];
  // The axis that the path has lost. The side on which the rest lies says which half the simplex
  // is.
  int axis = 0;
  while (m[axis] == first[axis] || last[axis] != first[axis]) ++axis;
  const bool even = first[axis] / (2 * (m[axis] - first[axis])) % 2 == 0;
  const auto& kept = even ? first : last;
  Coordinates<D> lost;
  for (int a = 0; a < D; ++a) lost[a] = 2 * m[a] - kept[a];
  if (even) {
    p.vertices[p.tag] = lost;
  } else {
    std::copy(s.vertices.begin(), s.vertices.begin() + p.tag, p.vertices.begin() + 1);
    p.vertices[0] = lost;
    p.mirrored = s.mirrored != ((p.tag & 1) != 0);
  }
  return p;
}

}  // namespace isostar
