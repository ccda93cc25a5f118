#include "polygonizer.h"

#include <bit>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "cell_table.h"
#include "crossings.h"
#include "trim.h"

namespace isostar {
namespace {

constexpr int kRows = 64;  // of a brick

/// Where the crossed edges of a brick along one set of axes are in the list of vertices, by row.
struct EdgeIndex {
  std::array<uint32_t, kRows> first;
  std::array<uint8_t, kRows> crossed;

  EdgeIndex() {}  // leaves them as they are: filling them with zeros first would take longer than counting

  [[nodiscard]] uint32_t vertex(unsigned row, unsigned x) const {
    return first[row] + static_cast<uint32_t>(std::popcount(crossed[row] & ((1u << x) - 1u)));
  }
};

/// World positions of the lattice's vertices; directions of normals.
class Frames {
 public:
  Frames(const Lattice<3>& lattice, const Placement& p, Frame frame) : lattice_(lattice), world_(frame == Frame::World) {
    for (int a = 0; a < 3; ++a) {
      origin_[a] = p.origin[a];
      for (int b = 0; b < 3; ++b) matrix_[b][a] = p.direction[static_cast<std::size_t>(a * 3 + b)] * p.spacing[static_cast<std::size_t>(b)];
    }
    if (world_) gradient_ = glm::transpose(glm::inverse(matrix_));
  }
  [[nodiscard]] glm::dvec3 sample(const Coordinates<3>& v) const {
    return {lattice_.sample(0, v[0]), lattice_.sample(1, v[1]), lattice_.sample(2, v[2])};
  }
  [[nodiscard]] glm::dvec3 place(const glm::dvec3& sample) const { return world_ ? origin_ + matrix_ * sample : sample; }
  [[nodiscard]] glm::dvec3 normal(const glm::dvec3& gradient) const { return world_ ? gradient_ * gradient : gradient; }
  [[nodiscard]] bool mirrors() const { return world_ && glm::determinant(matrix_) < 0; }

 private:
  Lattice<3> lattice_;
  bool world_;
  glm::dvec3 origin_{};
  glm::dmat3 matrix_{1.0}, gradient_{1.0};
};

class Polygonization {
 public:
  static constexpr uint64_t kBytesOfPlace = sizeof(uint8_t) + sizeof(uint32_t);  // of active_ and slot_

  /// `depth`: of each vertex inside the surface's domain, if that is not the box.
  Polygonization(const Surface<3>& surface, const MeshOptions& options, const Limits& limits, Mesh& out, std::vector<float>& depth)
      : surface_(surface), signs_(surface.signs), lattice_(signs_.lattice()), options_(options), frames_(lattice_, surface.placement, options.frame),
        limits_(limits), out_(out), depth_(depth), active_(activeBricks(signs_)), slot_(active_.size(), kNone) {
    for (unsigned parity = 0; parity < 8; ++parity) tables_[parity] = &cellTable(options.polygonizer, parity);
  }

  Error run() {
    uint32_t bricks = 0;
    for (std::size_t place = 0; place < active_.size(); ++place) {
      if (active_[place] != 0) slot_[place] = bricks++;
    }
    held_ = kBytesOfPlace * active_.size() + bricks * (sets() * sizeof(EdgeIndex) + sizeof(Window<3>));
    if (held_ > limits_.memory) return Error::OverLimit;
    index_.resize(bricks * sets());
    windows_.resize(bricks);
    for (std::size_t place = 0; place < active_.size(); ++place) {
      if (active_[place] == 0) continue;
      countEdges(place);
      if (vertices_ > std::min(limits_.vertices, kMostVertices)) return Error::OverLimit;
    }
    const bool ends = surface_.domain != nullptr;
    held_ += vertices_ * ((options_.normals ? 6 : 3) + (ends ? 1 : 0)) * sizeof(float);
    if (!makeRoom(vertices_ * 6 + kMostOfRow)) return Error::OverLimit;
    out_.positions.resize(vertices_ * 3);
    if (options_.normals) out_.normals.resize(vertices_ * 3);
    if (ends) depth_.resize(vertices_);
    for (std::size_t place = 0; place < active_.size(); ++place) {
      if (active_[place] != 0) placeVertices(place);
    }
    for (std::size_t place = 0; place < active_.size(); ++place) {
      if (active_[place] != 0 && !cutCells(place)) return Error::OverLimit;
    }
    out_.triangles.resize(corners_);
    return Error::None;
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;
  static constexpr uint64_t kMostVertices = UINT32_MAX - 7 * power(kBrickSide, 3);  // one more brick's can still be counted
  static constexpr std::size_t kMostOfRow = kBrickSide * CellCase::kMostTriangles * 3;
  using Bits = uint32_t;

  [[nodiscard]] unsigned lastAxes() const { return options_.polygonizer == Polygonizer::Cubes ? 4u : 7u; }
  [[nodiscard]] bool uses(unsigned axes) const { return options_.polygonizer == Polygonizer::Tetrahedra || std::has_single_bit(axes); }
  /// How many sets of axes edges run along.
  [[nodiscard]] std::size_t sets() const { return options_.polygonizer == Polygonizer::Cubes ? 3 : 7; }
  [[nodiscard]] static std::array<uint8_t, 8> numbersOfSets(Polygonizer polygonizer) {
    if (polygonizer == Polygonizer::Cubes) return {0, 0, 1, 0, 2, 0, 0, 0};
    return {0, 0, 1, 2, 3, 4, 5, 6};
  }
  [[nodiscard]] EdgeIndex* indexOf(std::size_t place) { return &index_[slot_[place] * sets()]; }

  void countEdges(std::size_t place) {
    const auto brick = signs_.table().brick(place);
    Window<3>& window = windows_[slot_[place]];
    window.load(signs_, brick);
    bool inner = true;
    for (int a = 0; a < 3; ++a) inner = inner && (brick[a] + 1) * kBrickSide <= lattice_.last[a];
    auto number = static_cast<uint32_t>(vertices_);
    for (unsigned axes = 1; axes <= lastAxes(); ++axes) {
      if (!uses(axes)) continue;
      EdgeIndex& index = indexOf(place)[number_[axes]];
      for (unsigned r = 0; r < kRows; ++r) {
        const Bits inside = inner ? 0xFF : edgesInside(lattice_, brick, r, axes);
        const Bits bits = crossedEdges(window, Window<3>::kOwnRows[r], r, axes) & inside;
        index.crossed[r] = static_cast<uint8_t>(bits);
        index.first[r] = number;
        number += static_cast<uint32_t>(std::popcount(bits));
      }
    }
    vertices_ = number;
  }

  /// |scalar - isovalue| in half quanta at a vertex of the window.
  [[nodiscard]] double size(int at) const {
    const int32_t value = scalars_.value[at];
    return value >= 0 ? value + surface_.positiveOffset : -double(value) + surface_.negativeOffset;
  }
  [[nodiscard]] double scalar(int at) const { return scalars_.value[at] >= 0 ? size(at) : -size(at); }
  [[nodiscard]] bool known(int at) const { return scalars_.value[at] != Scalars<3>::kUnknown; }

  void placeVertices(std::size_t place) {
    const auto brick = signs_.table().brick(place);
    scalars_.load(surface_.scalars, signs_.table(), brick);
    if (surface_.domain != nullptr) domain_.load(*surface_.domain, signs_.table(), brick);
    for (unsigned axes = 1; axes <= lastAxes(); ++axes) {
      if (!uses(axes)) continue;
      const EdgeIndex& index = indexOf(place)[number_[axes]];
      for (unsigned r = 0; r < kRows; ++r) {
        uint32_t id = index.first[r];
        for (Bits open = index.crossed[r]; open != 0; open &= open - 1) {
          placeVertex(brick, axes, r, static_cast<unsigned>(std::countr_zero(open)), id++);
        }
      }
    }
  }

  void placeVertex(const Coordinates<3>& brick, unsigned axes, unsigned r, unsigned x, uint32_t id) {
    const EdgeEnds<3> ends(brick, r, x, axes);
    const double from = size(ends.evenAt), to = size(ends.oddAt);
    const double t = from + to > 0 ? from / (from + to) : 0.5;
    const glm::dvec3 start = frames_.sample(ends.even), end = frames_.sample(ends.odd);
    write(out_.positions, id, frames_.place(start + t * (end - start)));
    if (surface_.domain != nullptr) depth_[id] = static_cast<float>(depthOf(ends, t));
    if (!options_.normals) return;
    glm::dvec3 gradient;
    for (int a = 0; a < 3; ++a) {
      if (axes == 1u << a) gradient[a] = (scalar(ends.oddAt) - scalar(ends.evenAt)) * (ends.odd[a] - ends.even[a]);
      else gradient[a] = across(ends, t, a);
    }
    const glm::dvec3 normal = frames_.normal(gradient);
    const double length = glm::length(normal);
    write(out_.normals, id, length > 0 ? normal / -length : glm::dvec3{0, 0, 1});
  }

  /// How deep a vertex on an edge lies in the domain. The ends of diagonals have not been told of a stream for `cubes`: another
  /// corner of the cell stands in for them, so that only cells are cut which the domain's boundary crosses.
  [[nodiscard]] double depthOf(const EdgeEnds<3>& ends, double t) const {
    const auto& depth = domain_.value;
    const auto toldAt = [&](int at, int otherEnd) {
      const int beside = ends.evenAt + ends.odd[0] - ends.even[0];  // if neither is told, all other corners are
      return depth[at] != Scalars<3>::kUnknown ? at : depth[otherEnd] != Scalars<3>::kUnknown ? otherEnd : beside;
    };
    const double even = depth[toldAt(ends.evenAt, ends.oddAt)], odd = depth[toldAt(ends.oddAt, ends.evenAt)];
    return even + t * (odd - even);
  }

  /// The field's difference along an axis across an edge, from the neighbours of its ends whose scalars are known.
  [[nodiscard]] double across(const EdgeEnds<3>& ends, double t, int axis) const {
    const int step = ScalarWindow<3>::stride(axis);
    double sum = 0, weight = 0;
    auto add = [&](int at, double share, bool ahead) {
      for (const int side : {-1, 1}) {
        if ((side > 0 && !ahead) || !known(at + side * step)) continue;
        sum += (share + 0.01) * side * (scalar(at + side * step) - scalar(at));
        weight += share + 0.01;
      }
    };
    // The further end of a diagonal may be the last vertex of the window.
    add(ends.evenAt, 1 - t, ends.even[axis] <= ends.odd[axis]);
    add(ends.oddAt, t, ends.odd[axis] <= ends.even[axis]);
    return weight > 0 ? sum / weight : 0;
  }

  static void write(std::vector<float>& values, uint32_t id, const glm::dvec3& v) {
    float* at = &values[std::size_t{id} * 3];
    at[0] = static_cast<float>(v.x);
    at[1] = static_cast<float>(v.y);
    at[2] = static_cast<float>(v.z);
  }

  /// Room for so many corners of triangles; false where the limit has none. Not by resize() alone, which may double it.
  bool makeRoom(std::size_t corners) {
    const std::size_t before = out_.triangles.capacity();
    if (corners > before && held_ + (uint64_t{before} + corners) * sizeof(uint32_t) > limits_.memory) return false;
    out_.triangles.reserve(corners);
    out_.triangles.resize(corners);
    return true;
  }

  /// False where the limit has no room for the triangles.
  bool cutCells(std::size_t place) {
    const auto brick = signs_.table().brick(place);
    const Window<3>& window = windows_[slot_[place]];
    std::array<const EdgeIndex*, 8> near{};
    for (unsigned c = 0; c < 8; ++c) {
      std::size_t other = place;
      bool inside = true;
      for (int a = 0; a < 3; ++a) {
        if ((c >> a & 1) == 0) continue;
        inside = inside && brick[a] + 1 < signs_.table().count(a);
        other += signs_.table().stride(a);
      }
      if (inside && slot_[other] != kNone) near[c] = indexOf(other);
    }
    for (unsigned r = 0; r < kRows; ++r) {
      const Bits inside = edgesInside(lattice_, brick, r, 7);
      if (inside == 0) continue;
      const int32_t y = static_cast<int32_t>(r & 7), z = static_cast<int32_t>(r >> 3);
      const int row = Window<3>::row({0, y, z});
      const Bits a = window.rows[row], b = window.rows[row + Window<3>::rowStride(1)];
      const Bits c = window.rows[row + Window<3>::rowStride(2)], d = window.rows[row + Window<3>::rowStride(1) + Window<3>::rowStride(2)];
      const Bits some = a | b | c | d, all = a & b & c & d;
      Bits open = ((some | some >> 1) & ~(all & all >> 1)) >> Window<3>::kHalo & inside;
      if (open == 0) continue;
      const EdgeRows rows = edgeRows(near, r);
      if (out_.triangles.size() - corners_ < kMostOfRow && !makeRoom(corners_ + corners_ / 8 + kMostOfRow)) return false;
      for (; open != 0; open &= open - 1) {
        const auto x = static_cast<unsigned>(std::countr_zero(open));
        const unsigned at = x + Window<3>::kHalo;
        const unsigned signs = (a >> at & 3) | (b >> at & 3) << 2 | (c >> at & 3) << 4 | (d >> at & 3) << 6;
        cutCell(rows, signs, x, r);
      }
    }
    return true;
  }

  /// A row of edges that cells of a row need: by corner on axes 1 and 2, then whether it lies in the next brick on axis 0.
  struct EdgeRow {
    const EdgeIndex* index;
    unsigned row;
  };
  using EdgeRows = std::array<EdgeRow, 8>;
  static EdgeRows edgeRows(const std::array<const EdgeIndex*, 8>& near, unsigned r) {
    EdgeRows rows;
    for (unsigned n = 0; n < rows.size(); ++n) {
      const unsigned y = (r & 7) + (n & 1), z = (r >> 3) + (n >> 1 & 1);
      rows[n] = {near[n >> 2 | (y >> 3) << 1 | (z >> 3) << 2], (y & 7) | (z & 7) << 3};
    }
    return rows;
  }

  void cutCell(const EdgeRows& rows, unsigned signs, unsigned x, unsigned r) {
    const CellCase& shape = (*tables_[(x & 1) | (r & 1) << 1 | (r >> 3 & 1) << 2])[signs];
    std::array<uint32_t, CellCase::kMostEdges> ids;
    for (std::size_t e = 0; e < shape.edgeCount; ++e) {
      const CellEdge edge = shape.edges[e];
      const unsigned ex = x + (edge.corner & 1);
      const EdgeRow& row = rows[(edge.corner >> 1) | (ex & kBrickSide) >> 1];
      ids[e] = row.index[number_[edge.axes]].vertex(row.row, ex & 7);
    }
    uint32_t* next = out_.triangles.data() + corners_;
    corners_ += std::size_t{shape.triangleCount} * 3;
    for (std::size_t i = 0; i < shape.triangleCount; ++i, next += 3) {
      const auto& t = shape.triangles[i];
      next[0] = ids[t[0]];
      next[mirrors_ ? 2 : 1] = ids[t[1]];
      next[mirrors_ ? 1 : 2] = ids[t[2]];
    }
  }

  const Surface<3>& surface_;
  const Signs<3>& signs_;
  Lattice<3> lattice_;
  MeshOptions options_;
  Frames frames_;
  bool mirrors_ = frames_.mirrors();
  std::array<const CellTable*, 8> tables_{};
  Limits limits_;
  uint64_t held_ = 0;  // bytes in use but for those of triangles
  Mesh& out_;
  std::vector<float>& depth_;
  std::vector<uint8_t> active_;
  std::vector<uint32_t> slot_;
  std::array<uint8_t, 8> number_ = numbersOfSets(options_.polygonizer);  // of a set of axes
  std::vector<EdgeIndex> index_;                                          // by brick, then by set of axes
  std::vector<Window<3>> windows_;
  uint64_t vertices_ = 0;
  std::size_t corners_ = 0;  // of triangles, so far
  ScalarWindow<3> scalars_, domain_;
};

}  // namespace

Error polygonize(const Surface<3>& surface, const MeshOptions& options, const Limits& limits, Mesh& out) {
  out = {};
  if (Polygonization::kBytesOfPlace * surface.signs.table().total() > limits.memory) return Error::OverLimit;
  std::vector<float> depth;
  Error error = Polygonization(surface, options, limits, out, depth).run();
  if (error == Error::None && surface.domain != nullptr) error = trim(depth, limits, out);
  if (error != Error::None) out = {};
  return error;
}

}  // namespace isostar
