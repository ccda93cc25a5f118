// Marching cubes and marching tetrahedra, brick by brick: counts crossing edges, places a vertex on
// each, and cuts cells by table.
#include "surface/polygonizer.h"

#include "surface/mesh_piece.h"
#include "surface/trim.h"
#include "util/cold_path.h"
#include "util/run_all.h"

namespace isostar {
namespace {

class Polygonization {
 public:
  /// `depth` receives by how much each vertex lies inside the surface's domain, if there is one.
  ISOSTAR_COLD Polygonization(const Surface<3>& surface, const MeshOptions& options,
                              const Limits& limits, const RunTasks& runTasks, EdgeNumbers numbers,
                              Mesh& out, std::vector<float>& depth, MeshPart* part)
      : surface_(surface),
        options_(options),
        frames_(surface.signs.lattice(), surface.placement, options.frame),
        cuts_(options.polygonizer, frames_.mirrors()),
        limits_(limits),
        runTasks_(runTasks),
        out_(out),
        depth_(depth),
        part_(part),
        numbers_(std::move(numbers)) {}

  ISOSTAR_COLD Error run() {
    held_ = numbers_.memory();
    if (held_ > limits_.memory) return Error::OverLimit;
    numbers_.makeRoom();
    const std::size_t pieces =
        kRunsTasks && runTasks_ && part_ == nullptr
            ? std::clamp<std::size_t>(numbers_.bricks() / kFewestBricks, 1, kMostPieces)
            : 1;
    if (!countVertices(pieces)) return Error::OverLimit;
    const bool ends = surface_.isTrimmed();
    held_ += vertices_ * ((options_.normals ? 6 : 3) + (ends ? 1 : 0)) * sizeof(float);
    if (held_ > limits_.memory) return Error::OverLimit;
    if (ends) depth_.resize(vertices_);
    return pieces == 1 ? makeAlone() : makePieces(pieces);
  }

 private:
  static constexpr std::size_t kFewestBricks = 128, kMostPieces = 16;
  /// One more brick's vertices can still be counted.
  static constexpr uint64_t kMostVertices = UINT32_MAX - 7 * power(kBrickSide, 3);
  /// A typical mesh has less than this many corners of triangles a vertex.
  static constexpr uint64_t kCorners = 6;

  [[nodiscard]] std::size_t boundary(std::size_t piece, std::size_t pieces) const {
    return numbers_.bricks() * piece / pieces;
  }

  /// False if there are too many.
  [[nodiscard]] bool countVertices(std::size_t pieces) {
    const uint64_t most = std::min(limits_.vertices, kMostVertices);
    std::vector<uint64_t>& counts = firstVertex_;
    counts.assign(pieces, 0);
    runAll(runTasks_, pieces, [&](std::size_t piece) {
      uint64_t& count = counts[piece];
      for (std::size_t slot = boundary(piece, pieces);
           slot < boundary(piece + 1, pieces) && count <= most; ++slot)
        count = numbers_.count(slot, static_cast<uint32_t>(count));
    });
    for (uint64_t& count : counts) {
      const uint64_t first = vertices_;
      vertices_ += count;
      count = first;
    }
    if (vertices_ > most) return false;
    runAll(runTasks_, pieces, [&](std::size_t piece) {
      if (counts[piece] == 0) return;
      for (std::size_t slot = boundary(piece, pieces); slot < boundary(piece + 1, pieces); ++slot)
        numbers_.shift(slot, static_cast<uint32_t>(counts[piece]));
    });
    return true;
  }

  [[nodiscard]] MeshPiece piece(std::vector<uint32_t>& indices, uint64_t most) {
    return {surface_, options_, frames_, cuts_, numbers_, out_, depth_, indices, most};
  }

  /// The first slot from `slot` on whose brick is wanted, or is not.
  [[nodiscard]] std::size_t next(std::size_t slot, bool wanted) const {
    const auto isWanted = [&](std::size_t i) {
      return part_ == nullptr || part_->bricks[numbers_.brickIndex(i)] != 0;
    };
    while (slot < numbers_.bricks() && isWanted(slot) != wanted) ++slot;
    return slot;
  }
  [[nodiscard]] uint32_t firstVertex(std::size_t slot) const {
    return slot < numbers_.bricks() ? numbers_.firstVertex(slot) : static_cast<uint32_t>(vertices_);
  }
  /// Calls visit(first slot, end) for the runs of wanted bricks.
  template <class Visit>
  void forEachRun(Visit visit) const {
    for (std::size_t slot = next(0, true); slot < numbers_.bricks();) {
      const std::size_t end = next(slot, false);
      visit(slot, end);
      slot = next(end, true);
    }
  }

  /// Makes all, or the bricks of the part: their vertices one after the other.
  ISOSTAR_COLD Error makeAlone() {
    uint64_t vertices = 0;
    forEachRun([&](std::size_t slot, std::size_t end) {
      vertices += firstVertex(end) - firstVertex(slot);
    });
    MeshPiece all = piece(out_.indices, limits_.memory - held_);
    if (!all.makeRoom(vertices * kCorners + MeshPiece::kMostOfPlane)) return Error::OverLimit;
    out_.positions.reserve(vertices * 3);
    if (options_.normals) out_.normals.reserve(vertices * 3);
    bool made = true;
    uint32_t placed = 0;
    forEachRun([&](std::size_t slot, std::size_t end) {
      const std::size_t before = all.corners();
      const uint32_t first = firstVertex(slot), count = firstVertex(end) - first;
      all.shiftVertices(first - placed);
      made = made && all.make(slot, end);
      placed += count;
      if (part_ != nullptr)
        part_->runs.push_back({static_cast<uint32_t>(slot), first, count,
                               static_cast<uint32_t>(all.corners() - before)});
    });
    return made ? Error::None : Error::OverLimit;
  }

  /// Vertices are made in their places, triangles joined afterwards.
  Error makePieces(std::size_t pieces) {
    out_.positions.resize(vertices_ * 3);
    if (options_.normals) out_.normals.resize(vertices_ * 3);
    const uint64_t most = (limits_.memory - held_) / (2 * pieces);
    std::vector<std::vector<uint32_t>> indices(pieces);
    std::vector<uint8_t> made(pieces);
    runAll(runTasks_, pieces, [&](std::size_t i) {
      MeshPiece part = piece(indices[i], most);
      const uint64_t end = i + 1 < pieces ? firstVertex_[i + 1] : vertices_;
      made[i] = part.makeRoom((end - firstVertex_[i]) * kCorners + MeshPiece::kMostOfPlane) &&
                        part.make(boundary(i, pieces), boundary(i + 1, pieces))
                    ? 1
                    : 0;
    });
    if (!std::ranges::all_of(made, [](uint8_t one) { return one != 0; })) {
      indices = {};
      return makeAlone();
    }
    std::size_t corners = 0;
    std::vector<std::size_t> first(pieces);
    for (std::size_t i = 0; i < pieces; ++i) {
      first[i] = corners;
      corners += indices[i].size();
    }
    out_.indices.resize(corners);
    runAll(runTasks_, pieces, [&](std::size_t i) {
      std::copy(indices[i].begin(), indices[i].end(),
                out_.indices.begin() + static_cast<std::ptrdiff_t>(first[i]));
    });
    return Error::None;
  }

  const Surface<3>& surface_;
  MeshOptions options_;
  Frames frames_;
  CellCuts cuts_;
  Limits limits_;
  const RunTasks& runTasks_;
  uint64_t held_ = 0;  // bytes in use except those of triangles
  Mesh& out_;
  std::vector<float>& depth_;
  MeshPart* const part_;
  EdgeNumbers numbers_;
  uint64_t vertices_ = 0;
  std::vector<uint64_t> firstVertex_;  // by piece
};

}  // namespace

ISOSTAR_COLD Error polygonize(const Surface<3>& surface, const MeshOptions& options,
                              const Limits& limits, const RunTasks& runTasks, Mesh& out,
                              MeshPart* part) {
  out = {};
  auto numbers = EdgeNumbers::of(surface.signs, options.polygonizer, limits.memory);
  if (!numbers) return Error::OverLimit;
  std::vector<float> depth;
  Error error =
      Polygonization(surface, options, limits, runTasks, *std::move(numbers), out, depth, part)
          .run();
  if (error == Error::None && surface.isTrimmed()) error = trim(depth, limits, out);
  if (error != Error::None) out = {};
  return error;
}

}  // namespace isostar
