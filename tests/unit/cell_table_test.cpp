#include "surface/cell_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <set>

namespace isostar {
namespace {

using Edge = std::pair<unsigned, unsigned>;  // corner and axes
using Segment = std::pair<Edge, Edge>;

Edge keyOf(const CellEdge& e) {
  return {e.corner, e.axes};
}

/// Does the edge lie in the near (far) face across an axis?
bool liesIn(const Edge& e, unsigned axis, bool far) {
  return (e.second >> axis & 1) == 0 && (e.first >> axis & 1) == (far ? 1u : 0u);
}

/// The segments that bound a case's surface, each in the direction of its triangle.
std::set<Segment> outlineOf(const CellCase& shape) {
  std::set<Segment> outline;
  for (std::size_t t = 0; t < shape.triangleCount; ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge a = keyOf(shape.edges[shape.triangles[t][i]]),
                 b = keyOf(shape.edges[shape.triangles[t][(i + 1) % 3]]);
      EXPECT_TRUE(outline.erase({b, a}) == 1 || outline.insert({a, b}).second)
          << "an edge of two triangles in the same direction";
    }
  }
  return outline;
}

/// The part of the outline in a face, moved to the face at zero.
std::set<Segment> inFace(const std::set<Segment>& outline, unsigned axis, bool far) {
  std::set<Segment> part;
  for (auto [a, b] : outline) {
    if (!liesIn(a, axis, far) || !liesIn(b, axis, far)) continue;
    a.first &= ~(1u << axis);
    b.first &= ~(1u << axis);
    part.insert({a, b});
  }
  return part;
}

/// The signs of a face's corners.
unsigned faceSigns(unsigned signs, unsigned axis, bool far) {
  unsigned bits = 0;
  for (unsigned c = 0; c < 8; ++c) {
    if ((c >> axis & 1) == (far ? 1u : 0u)) bits = bits << 1 | (signs >> c & 1);
  }
  return bits;
}

template <class Visit>
void forEachTable(Visit visit) {
  visit(Polygonizer::Cubes, 0u);
  for (unsigned parity = 0; parity < 8; ++parity) visit(Polygonizer::Tetrahedra, parity);
}

TEST(CellTable, crossesTheEdgesBetweenBothSigns) {
  forEachTable([](Polygonizer polygonizer, unsigned parity) {
    for (unsigned signs = 0; signs < 256; ++signs) {
      const CellCase& shape = cellTable(polygonizer, parity)[signs];
      std::set<Edge> axisEdges;
      for (std::size_t e = 0; e < shape.edgeCount; ++e) {
        const CellEdge edge = shape.edges[e];
        EXPECT_TRUE(std::has_single_bit(edge.axes) || polygonizer == Polygonizer::Tetrahedra);
        if (std::has_single_bit(edge.axes)) axisEdges.insert(keyOf(edge));
      }
      std::set<Edge> crossed;
      for (unsigned corner = 0; corner < 8; ++corner) {
        for (unsigned axes : {1u, 2u, 4u}) {
          if ((corner & axes) == 0 && (signs >> corner & 1) != (signs >> (corner | axes) & 1))
            crossed.insert({corner, axes});
        }
      }
      EXPECT_EQ(axisEdges, crossed) << "signs " << signs;
    }
  });
}

TEST(CellTable, outlinesLieInTheCellsFaces) {
  forEachTable([](Polygonizer polygonizer, unsigned parity) {
    for (unsigned signs = 0; signs < 256; ++signs) {
      const auto outline = outlineOf(cellTable(polygonizer, parity)[signs]);
      std::size_t inFaces = 0;
      for (unsigned axis = 0; axis < 3; ++axis) {
        for (const bool far : {false, true}) inFaces += inFace(outline, axis, far).size();
      }
      EXPECT_EQ(inFaces, outline.size()) << "signs " << signs << ", parity " << parity;
    }
  });
}

TEST(CellTable, cellsMeetInTheirCommonFace) {
  forEachTable([](Polygonizer polygonizer, unsigned parity) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      std::map<unsigned, std::set<Segment>> near;
      const unsigned next = polygonizer == Polygonizer::Cubes ? 0 : parity ^ 1u << axis;
      for (unsigned signs = 0; signs < 256; ++signs) {
        std::set<Segment> flipped;
        for (const auto& [a, b] :
             inFace(outlineOf(cellTable(polygonizer, next)[signs]), axis, false))
          flipped.insert({b, a});
        const auto [at, isFirst] = near.emplace(faceSigns(signs, axis, false), flipped);
        EXPECT_TRUE(isFirst || at->second == flipped)
            << "a face's outline depends on more than its signs: " << signs;
      }
      for (unsigned signs = 0; signs < 256; ++signs) {
        EXPECT_EQ(inFace(outlineOf(cellTable(polygonizer, parity)[signs]), axis, true),
                  near[faceSigns(signs, axis, true)])
            << "signs " << signs;
      }
    }
  });
}

TEST(CellTable, aSingleCornerIsCutOff) {
  const CellCase& shape = cellTable(Polygonizer::Cubes, 0)[1];
  ASSERT_EQ(int{shape.triangleCount}, 1);
  // Corner 0 is positive: seen from the far corner x, y, z follow counter-clockwise.
  std::vector<unsigned> axes;
  for (uint8_t e : shape.triangles[0]) axes.push_back(shape.edges[e].axes);
  std::rotate(axes.begin(), std::find(axes.begin(), axes.end(), 1u), axes.end());
  EXPECT_EQ(axes, (std::vector<unsigned>{1, 2, 4}));
}

}  // namespace
}  // namespace isostar
