// Marching cubes and marching tetrahedra, brick by brick: counts crossing edges, places a vertex on
// each, and cuts cells by table.
#include "surface/polygonizer.h"

#include <bit>
#include <cmath>

#include "scalars/crossings.h"
#include "surface/cell_cut.h"
#include "surface/corner_signs.h"
#include "surface/edge_index.h"
#include "surface/frames.h"
#include "surface/trim.h"

namespace isostar {
namespace {

class Polygonization {
 public:
  static constexpr uint64_t kBytesPerEntry =
      sizeof(uint8_t) + sizeof(uint32_t);  // of active_ and slot_, per brick index

  /// `depth` receives by how much each vertex lies inside the surface's domain, if there is one.
  Polygonization(const Surface<3>& surface, const MeshOptions& options, const Limits& limits,
                 Mesh& out, std::vector<float>& depth)
      : surface_(surface),
        signs_(surface.signs),
        lattice_(signs_.lattice()),
        options_(options),
        frames_(lattice_, surface.placement, options.frame),
        limits_(limits),
        out_(out),
        depth_(depth),
        active_(activeBricks(signs_)),
        slot_(active_.size(), kNone) {
    const bool mirrors = frames_.mirrors();
    cuts_.reserve(parities() * 256);
    for (unsigned parity = 0; parity < parities(); ++parity) {
      for (const CellCase& shape : cellTable(options.polygonizer, parity))
        cuts_.emplace_back(shape, mirrors);
    }
  }

  Error run() {
    uint32_t bricks = 0;
    for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
      if (active_[brickIndex] != 0) slot_[brickIndex] = bricks++;
    }
    held_ = kBytesPerEntry * active_.size() + bricks * sets() * sizeof(EdgeIndex);
    if (held_ > limits_.memory) return Error::OverLimit;
    index_.resize(bricks * sets());
    for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
      if (active_[brickIndex] == 0) continue;
      countEdges(brickIndex);
      if (vertices_ > std::min(limits_.vertices, kMostVertices)) return Error::OverLimit;
    }
    const bool ends = surface_.domain != nullptr;
    held_ += vertices_ * ((options_.normals ? 6 : 3) + (ends ? 1 : 0)) * sizeof(float);
    if (!makeRoom(vertices_ * 6 + kMostOfPlane)) return Error::OverLimit;
    out_.positions.reserve(vertices_ * 3);
    if (options_.normals) out_.normals.reserve(vertices_ * 3);
    if (ends) depth_.resize(vertices_);
    for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
      if (active_[brickIndex] == 0) continue;
      placeVertices(brickIndex);
      findVerticesAhead(brickIndex);
      if (!cutCells(brickIndex)) return Error::OverLimit;
    }
    out_.indices.resize(corners_);
    return Error::None;
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;
  /// One more brick's vertices can still be counted.
  static constexpr uint64_t kMostVertices = UINT32_MAX - 7 * power(kBrickSide, 3);
  static constexpr std::size_t kMostOfPlane =
      kBrickSide * kBrickSide * CellCase::kMostTriangles * 3;

  [[nodiscard]] unsigned lastAxes() const {
    return options_.polygonizer == Polygonizer::Cubes ? 4u : 7u;
  }
  [[nodiscard]] bool uses(unsigned axes) const {
    return options_.polygonizer == Polygonizer::Tetrahedra || std::has_single_bit(axes);
  }
  /// How many sets of axes there are along which edges run.
  [[nodiscard]] std::size_t sets() const {
    return options_.polygonizer == Polygonizer::Cubes ? 3 : 7;
  }
  /// How many cell tables there are, one per parity.
  [[nodiscard]] std::size_t parities() const {
    return options_.polygonizer == Polygonizer::Cubes ? 1 : 8;
  }
  [[nodiscard]] static std::array<uint8_t, 8> numbersOfSets(Polygonizer polygonizer) {
    if (polygonizer == Polygonizer::Cubes) return {0, 0, 1, 0, 2, 0, 0, 0};
    return {0, 0, 1, 2, 3, 4, 5, 6};
  }
  [[nodiscard]] EdgeIndex* indexOf(std::size_t brickIndex) {
    return &index_[slot_[brickIndex] * sets()];
  }

  void countEdges(std::size_t brickIndex) {
    const auto brick = signs_.table().brick(brickIndex);
    const CornerSigns corners(signs_, brickIndex);
    auto number = static_cast<uint32_t>(vertices_);
    for (unsigned axes = 1; axes <= lastAxes(); ++axes) {
      if (!uses(axes)) continue;
      EdgeIndex& index = indexOf(brickIndex)[number_[axes]];
      const auto inside = insideOf(lattice_, brick, axes);
      for (unsigned z = 0; z < kPlanes; ++z) {
        const uint64_t crossed = corners.crossedEdges(axes, z) & inside[z];
        index.planes[z] = {crossed, number};
        number += static_cast<uint32_t>(std::popcount(crossed));
      }
    }
    vertices_ = number;
  }

  /// |scalar| at a vertex of the window, in half quantization steps.
  [[nodiscard]] double size(int at) const {
    const int32_t value = scalars_.value[at];
    // A table instead of an unpredictable branch.
    return std::abs(double(value)) + offsets_[value < 0 ? 1 : 0];
  }
  [[nodiscard]] double scalar(int at) const {
    return scalars_.value[at] >= 0 ? size(at) : -size(at);
  }
  [[nodiscard]] bool known(int at) const { return scalars_.value[at] != Scalars<3>::kUnknown; }

  void placeVertices(std::size_t brickIndex) {
    const auto brick = signs_.table().brick(brickIndex);
    scalars_.load(surface_.scalars, signs_.table(), brick);
    if (surface_.domain != nullptr) domain_.load(*surface_.domain, signs_.table(), brick);
    for (unsigned axes = 1; axes <= lastAxes(); ++axes) {
      if (!uses(axes)) continue;
      for (unsigned z = 0; z < kPlanes; ++z) {
        auto [open, id] = indexOf(brickIndex)[number_[axes]].planes[z];
        grow(id + static_cast<uint32_t>(std::popcount(open)));
        for (; open != 0; open &= open - 1, ++id) {
          const auto at = static_cast<unsigned>(std::countr_zero(open));
          ids_[EdgePositions::at(axes, at % kBrickSide, at / kBrickSide, z)] = id;
          placeVertex(brick, axes, z, at, id);
        }
      }
    }
  }

  /// Creates vertices a plane at a time, just before they are placed: then they are in the cache.
  void grow(std::size_t vertices) {
    out_.positions.resize(vertices * 3);
    if (options_.normals) out_.normals.resize(vertices * 3);
  }

  void placeVertex(const Coordinates<3>& brick, unsigned axes, unsigned z, unsigned at,
                   uint32_t id) {
    const EdgeEnds<3> ends(brick, z * kBrickSide + at / kBrickSide, at % kBrickSide, axes);
    const double from = size(ends.evenAt), to = size(ends.oddAt);
    const double t = from + to > 0 ? from / (from + to) : 0.5;
    const glm::dvec3 start = frames_.sample(ends.even), end = frames_.sample(ends.odd);
    write(out_.positions, id, frames_.position(start + t * (end - start)));
    if (surface_.domain != nullptr) depth_[id] = static_cast<float>(depthOf(ends, t));
    if (!options_.normals) return;
    glm::dvec3 gradient;
    for (int a = 0; a < 3; ++a) {
      if (axes == 1u << a)
        gradient[a] = (scalar(ends.oddAt) - scalar(ends.evenAt)) * (ends.odd[a] - ends.even[a]);
      else
        gradient[a] = across(ends, t, a);
    }
    const glm::dvec3 normal = frames_.normal(gradient);
    const double length = glm::length(normal);
    write(out_.normals, id, length > 0 ? normal / -length : glm::dvec3{0, 0, 1});
  }

  /// By how much a vertex on an edge lies inside the domain. A stream for Polygonizer::Cubes does
  /// not code the ends of diagonals: another corner of the cell stands in for them, so that only
  /// cells are cut that the domain's boundary crosses.
  [[nodiscard]] double depthOf(const EdgeEnds<3>& ends, double t) const {
    const auto& depth = domain_.value;
    const auto knownAt = [&](int at, int otherEnd) {
      // If neither end is known, all other corners are.
      const int beside = ends.evenAt + ends.odd[0] - ends.even[0];
      return depth[at] != Scalars<3>::kUnknown         ? at
             : depth[otherEnd] != Scalars<3>::kUnknown ? otherEnd
                                                       : beside;
    };
    const double even = depth[knownAt(ends.evenAt, ends.oddAt)],
                 odd = depth[knownAt(ends.oddAt, ends.evenAt)];
    return even + t * (odd - even);
  }

  /// The field's difference along an axis orthogonal to an edge, from the neighbours of its ends
  /// whose scalars are known.
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

  /// Reserves room for `corners` corners of triangles; false if the limit does not allow it.
  /// resize() alone might double the capacity.
  bool makeRoom(std::size_t corners) {
    const std::size_t before = out_.indices.capacity();
    if (corners > before &&
        held_ + (uint64_t{before} + corners) * sizeof(uint32_t) > limits_.memory)
      return false;
    out_.indices.reserve(corners);
    return true;
  }

  /// Finds the vertices of the next bricks that this brick's last cells need.
  void findVerticesAhead(std::size_t brickIndex) {
    constexpr uint64_t kFirstColumn = 0x0101010101010101, kFirstRow = 0xFF;
    const auto brick = signs_.table().brick(brickIndex);
    for (unsigned ahead = 1; ahead < 8; ++ahead) {
      std::size_t other = brickIndex;
      bool inside = true;
      for (int a = 0; a < 3; ++a) {
        if ((ahead >> a & 1) == 0) continue;
        inside = inside && brick[a] + 1 < signs_.table().count(a);
        other += signs_.table().stride(a);
      }
      if (!inside || slot_[other] == kNone) continue;
      const uint64_t facing = ((ahead & 1) != 0 ? kFirstColumn : ~uint64_t{0}) &
                              ((ahead & 2) != 0 ? kFirstRow : ~uint64_t{0});
      const unsigned x = (ahead & 1) * kBrickSide, y = (ahead >> 1 & 1) * kBrickSide,
                     firstZ = (ahead >> 2) * kBrickSide;
      for (unsigned axes = 1; axes <= lastAxes(); ++axes) {
        if (!uses(axes) || (axes & ahead) != 0) continue;
        const EdgeIndex& index = indexOf(other)[number_[axes]];
        for (unsigned z = 0; z < ((ahead & 4) != 0 ? 1 : kPlanes); ++z) {
          for (uint64_t open = index.planes[z].crossed & facing; open != 0; open &= open - 1) {
            const auto at = static_cast<unsigned>(std::countr_zero(open));
            ids_[EdgePositions::at(axes, x + at % kBrickSide, y + at / kBrickSide, firstZ + z)] =
                index.vertex(z, at);
          }
        }
      }
    }
  }

  /// Appends the brick's triangles. False if the limit does not allow it.
  bool cutCells(std::size_t brickIndex) {
    const auto brick = signs_.table().brick(brickIndex);
    const CornerSigns corners(signs_, brickIndex);
    const auto inside = insideOf(lattice_, brick, 7);
    for (unsigned z = 0; z < kPlanes; ++z) {
      uint64_t open = corners.crossedCells(z) & inside[z];
      if (open == 0) continue;
      if (out_.indices.capacity() - corners_ < kMostOfPlane &&
          !makeRoom(corners_ + corners_ / 8 + kMostOfPlane))
        return false;
      out_.indices.resize(corners_ + kMostOfPlane);
      for (; open != 0; open &= open - 1) {
        const auto at = static_cast<unsigned>(std::countr_zero(open));
        cutCell(corners.around(z, at), at % kBrickSide, at / kBrickSide, z);
      }
    }
    return true;
  }

  /// Appends a cell's triangles. Most cells have one or two: two are always written, so that there
  /// are fewer branches to predict.
  void cutCell(unsigned signs, unsigned x, unsigned y, unsigned z) {
    constexpr std::size_t kAlways = 6;
    const std::size_t parity = ((x & 1) | (y & 1) << 1 | (z & 1) << 2) & (parities() - 1);
    const CellCut& cut = cuts_[parity * 256 + signs];
    const uint32_t* ids = &ids_[EdgePositions::at(1, x, y, z)];
    uint32_t* next = out_.indices.data() + corners_;
    for (std::size_t i = 0; i < kAlways; ++i) next[i] = ids[cut.edges[i]];
    for (std::size_t i = kAlways; i < cut.corners; ++i) next[i] = ids[cut.edges[i]];
    corners_ += cut.corners;
  }

  const Surface<3>& surface_;
  const Signs<3>& signs_;
  Lattice<3> lattice_;
  MeshOptions options_;
  Frames frames_;
  std::array<double, 2> offsets_{surface_.positiveOffset, surface_.negativeOffset};
  std::vector<CellCut> cuts_;  // by parity, if there are several tables; then by signs
  Limits limits_;
  uint64_t held_ = 0;  // bytes in use except those of triangles
  Mesh& out_;
  std::vector<float>& depth_;
  std::vector<uint8_t> active_;
  std::vector<uint32_t> slot_;
  /// Of a set of axes: its number among those used.
  std::array<uint8_t, 8> number_ = numbersOfSets(options_.polygonizer);
  std::array<uint32_t, EdgePositions::kCount> ids_{};  // of the vertices around the current brick
  std::vector<EdgeIndex> index_;  // by slot of a brick, then by number of the set of axes
  uint64_t vertices_ = 0;
  std::size_t corners_ = 0;  // of triangles so far
  ScalarWindow<3> scalars_, domain_;
};

}  // namespace

Error polygonize(const Surface<3>& surface, const MeshOptions& options, const Limits& limits,
                 Mesh& out) {
  out = {};
  if (Polygonization::kBytesPerEntry * surface.signs.table().total() > limits.memory)
    return Error::OverLimit;
  std::vector<float> depth;
  Error error = Polygonization(surface, options, limits, out, depth).run();
  if (error == Error::None && surface.domain != nullptr) error = trim(depth, limits, out);
  if (error != Error::None) out = {};
  return error;
}

}  // namespace isostar
