// The vertices and triangles of some bricks of a mesh.
#pragma once

#include <cmath>

#include "surface/brick_places.h"
#include "surface/cell_cuts.h"
#include "surface/edge_numbers.h"
#include "surface/surface.h"

namespace isostar {

/// Pieces of one mesh can be made side by side: each writes vertices of its own, and has its own
/// list of triangles.
class MeshPiece {
 public:
  /// `out`: receives the vertices; if it has room for all, that is used, else it grows. `depth`: by
  /// how much each vertex lies inside the surface's domain, if there is one. `indices`: receives
  /// the corners of triangles. `most`: bytes for them.
  MeshPiece(const Surface<3>& surface, const MeshOptions& options, const Frames& frames,
            const CellCuts& cuts, const EdgeNumbers& numbers, Mesh& out, std::vector<float>& depth,
            std::vector<uint32_t>& indices, uint64_t most)
      : surface_(surface),
        signs_(surface.signs),
        normals_(options.normals),
        frames_(frames),
        cuts_(cuts),
        numbers_(numbers),
        out_(out),
        depth_(depth),
        indices_(indices),
        most_(most) {}

  /// Makes the bricks of the slots first … end - 1. False if the limit does not allow it.
  [[nodiscard, gnu::noinline]] bool make(std::size_t first, std::size_t end) {
    for (std::size_t slot = first; slot < end; ++slot) {
      placeVertices(slot);
      findVerticesAhead(slot);
      if (!cutCells(numbers_.brickIndex(slot))) return false;
    }
    indices_.resize(corners_);
    return true;
  }
  /// The vertices of bricks made from now on have places in `out` that are `by` smaller than their
  /// numbers.
  void shiftVertices(uint32_t by) { shift_ = by; }
  /// How many corners of triangles have been made.
  [[nodiscard]] std::size_t corners() const { return corners_; }
  /// Reserves room for the corners of triangles; false if the limit does not allow it. resize()
  /// alone might double the capacity.
  [[nodiscard]] bool makeRoom(std::size_t corners) {
    const std::size_t before = indices_.capacity();
    if (corners > before && (uint64_t{before} + corners) * sizeof(uint32_t) > most_) return false;
    indices_.reserve(corners);
    return true;
  }

  static constexpr std::size_t kMostOfPlane =
      kBrickSide * kBrickSide * CellCase::kMostTriangles * 3;

 private:
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

  void placeVertices(std::size_t slot) {
    const auto brick = signs_.table().brick(numbers_.brickIndex(slot));
    scalars_.load(surface_.scalars, signs_.table(), brick);
    places_.enter(frames_, brick);
    if (surface_.isTrimmed()) domain_.load(*surface_.domain, signs_.table(), brick);
    for (unsigned axes = 1; axes <= numbers_.lastAxes(); ++axes) {
      if (!numbers_.uses(axes)) continue;
      for (unsigned z = 0; z < kPlanes; ++z) {
        auto [open, id] = numbers_.of(slot, axes).planes[z];
        grow(id - shift_ + static_cast<uint32_t>(std::popcount(open)));
        for (; open != 0; open &= open - 1, ++id) {
          const auto at = static_cast<unsigned>(std::countr_zero(open));
          ids_[EdgePositions::at(axes, at % kBrickSide, at / kBrickSide, z)] = id;
          placeVertex(axes, z, at, id - shift_);
        }
      }
    }
  }

  /// Creates vertices a plane at a time, just before they are placed: then they are in the cache.
  void grow(std::size_t vertices) {
    if (out_.positions.size() >= vertices * 3) return;
    out_.positions.resize(vertices * 3);
    if (normals_) out_.normals.resize(vertices * 3);
  }

  /// `place`: of the vertex in `out`.
  void placeVertex(unsigned axes, unsigned z, unsigned at, uint32_t place) {
    const EdgeEnds<3> ends({}, z * kBrickSide + at / kBrickSide, at % kBrickSide, axes);
    const double from = size(ends.evenAt), to = size(ends.oddAt);
    const double t = from + to > 0 ? from / (from + to) : 0.5;
    const BrickPlaces::Place point = places_.between(ends.even, ends.odd, t);
    write(out_.positions, place, point.xy[0], point.xy[1], point.z[0]);
    if (surface_.isTrimmed()) depth_[place] = static_cast<float>(depthOf(ends, t));
    if (!normals_) return;
    glm::dvec3 gradient;
    for (int a = 0; a < 3; ++a) {
      if (axes == 1u << a)
        gradient[a] = (scalar(ends.oddAt) - scalar(ends.evenAt)) * (ends.odd[a] - ends.even[a]);
      else
        gradient[a] = across(ends, t, a);
    }
    const glm::dvec3 normal = frames_.normal(gradient);
    const double length = glm::length(normal);
    const glm::dvec3 unit = length > 0 ? normal / -length : glm::dvec3{0, 0, 1};
    write(out_.normals, place, unit.x, unit.y, unit.z);
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

  static void write(std::vector<float>& values, uint32_t place, double x, double y, double z) {
    float* at = &values[std::size_t{place} * 3];
    at[0] = static_cast<float>(x);
    at[1] = static_cast<float>(y);
    at[2] = static_cast<float>(z);
  }

  /// Finds the vertices of the next bricks that this brick's last cells need.
  void findVerticesAhead(std::size_t slot) {
    const std::size_t brickIndex = numbers_.brickIndex(slot);
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
      if (!inside || numbers_.slot(other) == EdgeNumbers::kNone) continue;
      const uint64_t facing = ((ahead & 1) != 0 ? kFirstColumn : ~uint64_t{0}) &
                              ((ahead & 2) != 0 ? kFirstRow : ~uint64_t{0});
      const unsigned x = (ahead & 1) * kBrickSide, y = (ahead >> 1 & 1) * kBrickSide,
                     firstZ = (ahead >> 2) * kBrickSide;
      for (unsigned axes = 1; axes <= numbers_.lastAxes(); ++axes) {
        if (!numbers_.uses(axes) || (axes & ahead) != 0) continue;
        const EdgeIndex& index = numbers_.of(numbers_.slot(other), axes);
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
    const auto inside = insideOf(signs_.lattice(), brick, 7);
    for (unsigned z = 0; z < kPlanes; ++z) {
      uint64_t open = corners.crossedCells(z) & inside[z];
      if (open == 0) continue;
      if (indices_.capacity() - corners_ < kMostOfPlane &&
          !makeRoom(corners_ + corners_ / 8 + kMostOfPlane))
        return false;
      indices_.resize(corners_ + kMostOfPlane);
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
    const std::size_t parity = ((x & 1) | (y & 1) << 1 | (z & 1) << 2) & (cuts_.parities() - 1);
    const CellCut& cut = cuts_.of(parity, signs);
    const uint32_t* ids = &ids_[EdgePositions::at(1, x, y, z)];
    uint32_t* next = indices_.data() + corners_;
    for (std::size_t i = 0; i < kAlways; ++i) next[i] = ids[cut.edges[i]];
    for (std::size_t i = kAlways; i < cut.corners; ++i) next[i] = ids[cut.edges[i]];
    corners_ += cut.corners;
  }

  const Surface<3>& surface_;
  const Signs<3>& signs_;
  const bool normals_;
  const Frames& frames_;
  const CellCuts& cuts_;
  const EdgeNumbers& numbers_;
  std::array<double, 2> offsets_{surface_.positiveOffset, surface_.negativeOffset};
  Mesh& out_;
  std::vector<float>& depth_;
  std::vector<uint32_t>& indices_;
  const uint64_t most_;
  std::array<uint32_t, EdgePositions::kCount> ids_{};  // of the vertices around the current brick
  std::size_t corners_ = 0;                            // of triangles so far
  uint32_t shift_ = 0;
  BrickPlaces places_;  // of the current brick
  ScalarWindow<3> scalars_, domain_;
};

}  // namespace isostar
