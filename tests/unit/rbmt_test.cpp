#include "bisection/rbmt.h"

#include <gtest/gtest.h>

#include <string>

#include "bisection/leaves.h"

namespace isostar {
namespace {

/// A drawing of a mesh in two dimensions, two characters per step; y grows downwards.
class Drawing {
 public:
  explicit Drawing(const Rbmt<2>& mesh)
      : lines_(static_cast<std::size_t>(2 * mesh.hierarchy().box()[1] + 1),
               std::string(static_cast<std::size_t>(2 * mesh.hierarchy().box()[0] + 1), ' ')) {
    forEachLeaf(mesh, [&](const TaggedSimplex<2>& leaf) {
      for (int i = 0; i < 3; ++i)
        edge(mesh.hierarchy().position(leaf.vertices[i]),
             mesh.hierarchy().position(leaf.vertices[(i + 1) % 3]));
    });
    forEachLeaf(mesh, [&](const TaggedSimplex<2>& leaf) {
      for (const auto& v : leaf.vertices) at(mesh.hierarchy().position(v), 2) = 'o';
    });
  }
  [[nodiscard]] std::string text() const {
    std::string all = "\n";
    for (const auto& line : lines_) all += line + '\n';
    return all;
  }

 private:
  char& at(const Coordinates<2>& v, int32_t scale) {
    return lines_[static_cast<std::size_t>(v[1] * scale)][static_cast<std::size_t>(v[0] * scale)];
  }
  void edge(const Coordinates<2>& from, const Coordinates<2>& to) {
    const Coordinates<2> d{to[0] - from[0], to[1] - from[1]};
    const int32_t length = 2 * std::max(std::abs(d[0]), std::abs(d[1]));
    const char letter = d[1] == 0 ? '-' : d[0] == 0 ? '|' : (d[0] > 0) == (d[1] > 0) ? '\\' : '/';
    for (int32_t i = 0; i <= length; ++i)
      at({2 * from[0] + 2 * d[0] * i / length, 2 * from[1] + 2 * d[1] * i / length}, 1) = letter;
  }

  std::vector<std::string> lines_;
};

Rbmt<2> meshWith(const Hierarchy<2>& hierarchy, const Rbmt<2>::Vertices& vertices) {
  Rbmt<2> mesh(hierarchy);
  Rbmt<2>::Vertices added;
  for (const auto& v : vertices) mesh.split(v, added);
  return mesh;
}

TEST(Rbmt, cellsOfTheBaseMirrorEachOther) {
  EXPECT_EQ(Drawing(Rbmt<2>(Hierarchy<2>({8, 4}, 2))).text(), R"(
o-------o-------o
|\      |      /|
| \     |     / |
|  \    |    /  |
|   \   |   /   |
|    \  |  /    |
|     \ | /     |
|      \|/      |
o-------o-------o
)");
}

TEST(Rbmt, aSplitAddsItsAncestors) {
  const Hierarchy<2> hierarchy({8, 4}, 2);
  Rbmt<2> mesh(hierarchy);
  Rbmt<2>::Vertices added;
  EXPECT_FALSE(mesh.canSplit({1, 1}));
  mesh.split({1, 1}, added);
  EXPECT_EQ(added, (Rbmt<2>::Vertices{{2, 2}, {2, 0}, {0, 2}, {1, 1}}));
  EXPECT_EQ(Drawing(mesh).text(), R"(
o---o---o-------o
|\ /|  /|      /|
| o | / |     / |
|/ \|/  |    /  |
o---o   |   /   |
|  / \  |  /    |
| /   \ | /     |
|/     \|/      |
o-------o-------o
)");
}

TEST(Rbmt, refinementPropagates) {
  // A vertex on the common side of both cells needs the small cells beside it on either side, and
  // these need the cells' centres.
  EXPECT_EQ(Drawing(meshWith(Hierarchy<2>({8, 4}, 2), {{7, 1}, {4, 1}})).text(), R"(
o---o---o---o---o
|\  |\ /|\ /|\ /|
| \ | o-o-o | o |
|  \|/ \|/ \|/ \|
|   o---o---o---o
|  / \  |  / \  |
| /   \ | /   \ |
|/     \|/     \|
o-------o-------o
)");
}

TEST(Rbmt, aWeldRemovesItsDescendants) {
  const Hierarchy<2> hierarchy({8, 4}, 2);
  auto mesh = meshWith(hierarchy, {{1, 1}, {7, 3}});
  Rbmt<2>::Vertices removed;
  EXPECT_FALSE(mesh.canWeld({0, 2}));
  mesh.weld({0, 2}, removed);
  EXPECT_EQ(removed, (Rbmt<2>::Vertices{{1, 1}, {0, 2}}));
  EXPECT_EQ(Drawing(mesh).text(), R"(
o---o---o-------o
|\  |  /|\     /|
| \ | / | \   / |
|  \|/  |  \ /  |
|   o   |   o---o
|  / \  |  /|\ /|
| /   \ | / | o |
|/     \|/  |/ \|
o-------o---o---o
)");
}

TEST(Rbmt, verticesBeyondTheBoxLieAtItsEnd) {
  // A box of 5 by 2 steps, cells of 4: the right cell ends after one step, both after two. Of the
  // four triangles around the left cell's middle the one below is flat.
  const Hierarchy<2> hierarchy({5, 2}, 2);
  EXPECT_EQ(Drawing(meshWith(hierarchy, {{2, 2}})).text(), R"(
o-------o-o
|\     /|/|
| \   / |/|
|  \ /  / |
o---o---o-o
)");
}

}  // namespace
}  // namespace isostar
