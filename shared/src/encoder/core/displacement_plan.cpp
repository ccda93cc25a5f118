// Finds the displacements of a pass, and the error that they leave.
#include "encoder/core/displacement_plan.h"

#include <cmath>
#include <memory>

#include "grid/tube.h"
#include "scalars/crossings.h"
#include "scalars/displacement_window.h"

namespace isostar {
namespace {

/// The mean error, in grid steps, of one cube.
struct Mean {
  float sum = 0;
  uint32_t count = 0;

  void add(double error) {
    sum += static_cast<float>(error);
    ++count;
  }
  [[nodiscard]] int8_t steps(double step) const {
    constexpr double kWorthCoding = 0.6, kMost = 4;
    const double steps = count == 0 ? 0 : sum / count / step;
    return static_cast<int8_t>(
        std::abs(steps) < kWorthCoding ? 0 : std::clamp(std::round(steps), -kMost, kMost));
  }
};

/// By block: the block at the lower corner of its cube of 2^log2Side vertices on a side.
template <int D>
std::array<uint8_t, Displacements<D>::kBlocks> cubes(int log2Side) {
  std::array<uint8_t, Displacements<D>::kBlocks> corners{};
  for (std::size_t block = 0; block < corners.size(); ++block) {
    std::size_t corner = 0, stride = 1, digits = block;
    for (int a = 0; a < D; ++a, stride *= Displacements<D>::kSide) {
      corner += (digits % Displacements<D>::kSide >> (log2Side - 1) << (log2Side - 1)) * stride;
      digits /= Displacements<D>::kSide;
    }
    corners[block] = static_cast<uint8_t>(corner);
  }
  return corners;
}

/// Adds in the order of edges, so that the sum does not depend on pieces.
double rms(const std::vector<std::vector<double>>& errors) {
  double squares = 0;
  std::size_t edges = 0;
  for (const auto& piece : errors) {
    for (const double error : piece) squares += error * error;
    edges += piece.size();
  }
  return edges == 0 ? 0 : std::sqrt(squares / static_cast<double>(edges));
}

}  // namespace

template <int D>
DisplacementPlan<D>::DisplacementPlan(const GridField<D>& field, const Signs<D>& signs,
                                      const std::vector<uint8_t>& active, SmoothingFilter filter,
                                      const RunTasks& runTasks)
    : signs_(signs), active_(active), runTasks_(runTasks), slot_(active.size()) {
  uint32_t slots = 0;
  for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
    if (active[brickIndex] != 0) slot_[brickIndex] = slots++;
  }
  blocks_.resize(slots);
  const std::unique_ptr<Estimates[]> estimates(new Estimates[slots]);  // not filled
  const auto ranges = brickPieces(active);
  runAll(runTasks, ranges.size(),
         [&](std::size_t i) { estimate(ranges[i], filter, estimates.get()); });
  pieces_.resize(ranges.size());
  runAll(runTasks, ranges.size(),
         [&](std::size_t i) { pieces_[i] = pieceOf(ranges[i], field, estimates.get()); });
}

template <int D>
void DisplacementPlan<D>::estimate(const BrickRange& range, SmoothingFilter filter,
                                   Estimates* estimates) {
  Tube<D> tube;
  ShapeEstimate<D> shapes(filter);
  for (std::size_t brickIndex = range.first; brickIndex < range.end; ++brickIndex) {
    if (active_[brickIndex] == 0) continue;
    tube.enter(signs_, brickIndex, Members::AxisEnds);
    if (tube.empty()) continue;
    shapes.load(tube.window());
    Estimates& here = estimates[slot_[brickIndex]];
    tube.forEach([&](int, std::size_t r, int x) {
      here[r * kBrickSide + static_cast<std::size_t>(x)] = static_cast<int16_t>(shapes.sum(r, x));
    });
    Blocks& blocks = blocks_[slot_[brickIndex]];
    tube.forEach(true,
                 [&](int, std::size_t r, int x) { blocks[Displacements<D>::block(r, x)] = 1; });
  }
}

template <int D>
typename DisplacementPlan<D>::Piece DisplacementPlan<D>::pieceOf(const BrickRange& range,
                                                                 const GridField<D>& field,
                                                                 const Estimates* estimates) const {
  constexpr std::size_t kTypicalEdges = 64;  // of a brick
  Piece piece{range, {}, {}};
  piece.first.reserve(range.end - range.first + 1);
  piece.edges.reserve(kTypicalEdges *
                      static_cast<std::size_t>(
                          std::count(active_.begin() + static_cast<std::ptrdiff_t>(range.first),
                                     active_.begin() + static_cast<std::ptrdiff_t>(range.end), 1)));
  const auto finish = [&](std::size_t brickIndex) {
    piece.first.resize(brickIndex - range.first + 1, piece.edges.size());
  };
  forCrossedRows(
      signs_, active_, range, false, finish,
      [&](const Coordinates<D>& brick, unsigned r, unsigned axes, uint32_t crossed) {
        for (; crossed != 0; crossed &= crossed - 1) {
          const EdgeEnds<D> ends(brick, r, static_cast<unsigned>(std::countr_zero(crossed)), axes);
          piece.edges.push_back(edgeOf(field, ends, brick, std::countr_zero(axes), estimates));
        }
      });
  finish(range.end);
  return piece;
}

template <int D>
typename DisplacementPlan<D>::Edge DisplacementPlan<D>::edgeOf(const GridField<D>& field,
                                                               const EdgeEnds<D>& ends,
                                                               const Coordinates<D>& brick,
                                                               int axis,
                                                               const Estimates* estimates) const {
  const auto& table = signs_.table();
  const auto even = signs_.lattice().samples(ends.even), odd = signs_.lattice().samples(ends.odd);
  const double at = field.crossing(even, odd, static_cast<std::size_t>(axis));
  const bool positive = field.scalar(even) > 0;
  Edge edge{{}, {}, static_cast<float>(positive ? at : -1 - at), 0, 0, static_cast<uint8_t>(axis)};
  const std::size_t own = table.index(brick);
  for (const std::size_t end : {0, 1}) {
    const auto& v = end == 0 ? ends.even : ends.odd;
    const std::size_t number = numberOf<D>(v);
    const bool beyond = v[axis] / kBrickSide != brick[axis];
    const std::size_t brickIndex = beyond ? own + table.stride(axis) : own;
    edge.vertices[end] = beyond ? kBeyond : static_cast<uint16_t>(number);
    edge.estimates[end] = estimates[slot_[brickIndex]][number];
    if (positive != (end == 0)) continue;
    edge.positiveSlot = slot_[brickIndex];
    edge.positiveBlock = static_cast<uint8_t>(
        Displacements<D>::block(number / kBrickSide, static_cast<int>(number % kBrickSide)));
  }
  return edge;
}

template <int D>
int32_t DisplacementPlan<D>::displacementAt(const DisplacementWindow<D>& displaced,
                                            const Edge& edge, std::size_t end) {
  if (edge.vertices[end] != kBeyond)
    return displaced.at(edge.vertices[end] / kBrickSide, edge.vertices[end] % kBrickSide);
  auto vertex = vertexOf<D>({}, edge.vertices[1 - end]);
  vertex[edge.axis] = kBrickSide;
  return displaced.smooth(vertex);
}

template <int D>
std::vector<double> DisplacementPlan<D>::errorsOf(const Piece& piece,
                                                  const Displacements<D>& coded) const {
  constexpr double kSlope = Displacements<D>::kPlaneSlope,
                   kLeast = kSlope / 8;  // the same as in completion.h
  const auto& table = signs_.table();
  const bool displaces = coded.tableSize() != 0;
  DisplacementWindow<D> displaced;
  std::vector<double> errors;
  errors.reserve(piece.edges.size());
  for (std::size_t b = 0; b + 1 < piece.first.size(); ++b) {
    if (piece.first[b] == piece.first[b + 1]) continue;
    if (displaces) {
      displaced.load(coded, table, table.brick(piece.range.first + b));
      displaced.spread();
    }
    for (std::size_t i = piece.first[b]; i < piece.first[b + 1]; ++i) {
      const Edge& edge = piece.edges[i];
      const bool positive = edge.crossing >= 0;
      const double side = positive ? 1 : -1, at = positive ? edge.crossing : -1 - edge.crossing;
      const auto shown = [&](std::size_t end, double sign) {
        return std::max(
            sign * (edge.estimates[end] - (displaces ? displacementAt(displaced, edge, end) : 0)),
            kLeast);
      };
      const double here = shown(0, side), there = shown(1, -side);
      errors.push_back(side * (here - at * (here + there)) / kSlope);
    }
  }
  return errors;
}

template <int D>
std::vector<std::vector<double>> DisplacementPlan<D>::errorsBy(
    const Displacements<D>& coded) const {
  std::vector<std::vector<double>> errors(pieces_.size());
  runAll(runTasks_, pieces_.size(),
         [&](std::size_t i) { errors[i] = errorsOf(pieces_[i], coded); });
  return errors;
}

template <int D>
Displacements<D> DisplacementPlan<D>::reached(const Displacements<D>& coded,
                                              const Displacements<D>& steps,
                                              const DisplacementPass& pass) const {
  const auto cubeOf = cubes<D>(pass.log2Side);
  Displacements<D> result = coded.tableSize() == 0 ? Displacements<D>(active_.size()) : coded;
  for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
    if (active_[brickIndex] == 0) continue;
    const Blocks& blocks = blocks_[slot_[brickIndex]];
    auto& brick = result.writable(brickIndex);
    for (std::size_t block = 0; block < blocks.size(); ++block) {
      if (blocks[block] != 0)
        Displacements<D>::move(brick[block], steps.at(brickIndex)[cubeOf[block]] * pass.step);
    }
  }
  return result;
}

template <int D>
double DisplacementPlan<D>::error(const Displacements<D>& coded) const {
  return rms(errorsBy(coded));
}

template <int D>
typename DisplacementPlan<D>::Next DisplacementPlan<D>::next(const Displacements<D>& coded,
                                                             const DisplacementPass& pass) const {
  const double step = static_cast<double>(pass.step) / Displacements<D>::kPerStep;
  const auto cubeOf = cubes<D>(pass.log2Side);
  const auto errors = errorsBy(coded);
  std::vector<std::array<Mean, Displacements<D>::kBlocks>> means(blocks_.size());
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    for (std::size_t e = 0; e < errors[i].size(); ++e) {
      const Edge& edge = pieces_[i].edges[e];
      means[edge.positiveSlot][cubeOf[edge.positiveBlock]].add(errors[i][e]);
    }
  }
  Next next{Displacements<D>(active_.size()), rms(errors)};
  for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
    if (active_[brickIndex] == 0) continue;
    const auto& of = means[slot_[brickIndex]];
    if (std::ranges::all_of(of, [](const Mean& mean) { return mean.count == 0; })) continue;
    std::transform(of.begin(), of.end(), next.steps.writable(brickIndex).begin(),
                   [&](const Mean& mean) { return mean.steps(step); });
  }
  return next;
}

template class DisplacementPlan<2>;
template class DisplacementPlan<3>;
template class DisplacementPlan<4>;

}  // namespace isostar
