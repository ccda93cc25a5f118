// Finds the displacements of a pass, and the error that they leave.
#include "encoder/core/displacement_plan.h"

#include <cmath>

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

/// Means by brick index and block; bricks are made on demand.
template <int D>
class Means {
 public:
  using Brick = std::array<Mean, Displacements<D>::kBlocks>;

  explicit Means(std::size_t tableSize) : at_(tableSize, 0) {}
  Mean& at(std::size_t brickIndex, std::size_t block) {
    if (at_[brickIndex] == 0) {
      bricks_.emplace_back();
      at_[brickIndex] = static_cast<uint32_t>(bricks_.size());
    }
    return bricks_[at_[brickIndex] - 1][block];
  }
  [[nodiscard]] const Brick* find(std::size_t brickIndex) const {
    return at_[brickIndex] == 0 ? nullptr : &bricks_[at_[brickIndex] - 1];
  }

 private:
  std::vector<uint32_t> at_;
  std::vector<Brick> bricks_;
};

/// The block at the lower corner of a block's cube.
template <int D>
std::size_t cubeOf(std::size_t block, int log2Side) {
  std::size_t corner = 0, stride = 1;
  for (int a = 0; a < D; ++a, block /= Displacements<D>::kSide, stride *= Displacements<D>::kSide) {
    corner += (block % Displacements<D>::kSide >> (log2Side - 1) << (log2Side - 1)) * stride;
  }
  return corner;
}

}  // namespace

template <int D>
DisplacementPlan<D>::DisplacementPlan(const GridField<D>& field, const Signs<D>& signs,
                                      const std::vector<uint8_t>& active, SmoothingFilter filter)
    : signs_(signs), active_(active), first_(active.size() + 1), blocks_(active.size()) {
  Scalars<D> estimates(active.size());
  Tube<D> tube;
  ShapeEstimate<D> shapes(filter);
  for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
    if (active[brickIndex] == 0) continue;
    tube.enter(signs, brickIndex, Members::AxisEnds);
    if (tube.empty()) continue;
    shapes.load(tube.window());
    auto& brick = estimates.writable(brickIndex);
    tube.forEach([&](int, std::size_t r, int x) {
      brick.value[r * kBrickSide + static_cast<std::size_t>(x)] = shapes.sum(r, x);
    });
    auto& blocks = blocks_.writable(brickIndex);
    tube.forEach(true,
                 [&](int, std::size_t r, int x) { blocks[Displacements<D>::block(r, x)] = 1; });
  }
  const auto& table = signs.table();
  ScalarWindow<D> window;
  std::size_t entered = 0;
  const auto finish = [&](std::size_t brickIndex) {
    while (entered < brickIndex) first_[++entered] = edges_.size();
  };
  forCrossedRows(
      signs, active, false,
      [&](std::size_t brickIndex) {
        finish(brickIndex);
        window.load(estimates, table, table.brick(brickIndex));
      },
      [&](const Coordinates<D>& brick, unsigned r, unsigned axes, uint32_t crossed) {
        for (; crossed != 0; crossed &= crossed - 1) {
          const EdgeEnds<D> ends(brick, r, static_cast<unsigned>(std::countr_zero(crossed)), axes);
          edges_.push_back(edgeOf(field, signs, ends, brick, std::countr_zero(axes)));
          edges_.back().estimates = {window.value[static_cast<std::size_t>(ends.evenAt)],
                                     window.value[static_cast<std::size_t>(ends.oddAt)]};
        }
      });
  finish(active.size());
}

template <int D>
typename DisplacementPlan<D>::Edge DisplacementPlan<D>::edgeOf(const GridField<D>& field,
                                                               const Signs<D>& signs,
                                                               const EdgeEnds<D>& ends,
                                                               const Coordinates<D>& brick,
                                                               int axis) {
  const auto even = signs.lattice().samples(ends.even), odd = signs.lattice().samples(ends.odd);
  const double at = field.crossing(even, odd, static_cast<std::size_t>(axis));
  const bool positive = field.scalar(even) > 0;
  Edge edge{{}, {}, static_cast<float>(positive ? at : -1 - at), 0, 0, static_cast<uint8_t>(axis)};
  for (const std::size_t end : {0, 1}) {
    const auto& v = end == 0 ? ends.even : ends.odd;
    edge.vertices[end] =
        v[axis] / kBrickSide == brick[axis] ? static_cast<uint16_t>(numberOf<D>(v)) : kBeyond;
  }
  const auto& end = positive ? ends.even : ends.odd;
  const std::size_t number = numberOf<D>(end);
  edge.positiveBrick = static_cast<uint32_t>(signs.table().brickIndexOf(end));
  edge.positiveBlock = static_cast<uint8_t>(
      Displacements<D>::block(number / kBrickSide, static_cast<int>(number % kBrickSide)));
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
template <class Visit>
void DisplacementPlan<D>::forEachError(const Displacements<D>& coded, Visit visit) const {
  constexpr double kSlope = Displacements<D>::kPlaneSlope,
                   kLeast = kSlope / 8;  // the same as in completion.h
  const auto& table = signs_.table();
  const bool displaces = coded.tableSize() != 0;
  DisplacementWindow<D> displaced;
  for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
    if (first_[brickIndex] == first_[brickIndex + 1]) continue;
    if (displaces) {
      displaced.load(coded, table, table.brick(brickIndex));
      displaced.spread();
    }
    for (std::size_t i = first_[brickIndex]; i < first_[brickIndex + 1]; ++i) {
      const Edge& edge = edges_[i];
      const bool positive = edge.crossing >= 0;
      const double side = positive ? 1 : -1, at = positive ? edge.crossing : -1 - edge.crossing;
      const auto shown = [&](std::size_t end, double sign) {
        return std::max(
            sign * (edge.estimates[end] - (displaces ? displacementAt(displaced, edge, end) : 0)),
            kLeast);
      };
      const double a = shown(0, side), b = shown(1, -side);
      visit(edge, side * (a - at * (a + b)) / kSlope);
    }
  }
}

template <int D>
Displacements<D> DisplacementPlan<D>::reached(const Displacements<D>& coded,
                                              const Displacements<D>& steps,
                                              const DisplacementPass& pass) const {
  Displacements<D> result = coded.tableSize() == 0 ? Displacements<D>(active_.size()) : coded;
  for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
    if (active_[brickIndex] == 0) continue;
    const auto& blocks = blocks_.at(brickIndex);
    auto& brick = result.writable(brickIndex);
    for (std::size_t block = 0; block < blocks.size(); ++block) {
      if (blocks[block] == 1)
        Displacements<D>::move(brick[block],
                               steps.at(brickIndex)[cubeOf<D>(block, pass.log2Side)] * pass.step);
    }
  }
  return result;
}

template <int D>
double DisplacementPlan<D>::error(const Displacements<D>& coded) const {
  double squares = 0;
  std::size_t edges = 0;
  forEachError(coded, [&](const Edge&, double error) {
    squares += error * error;
    ++edges;
  });
  return edges == 0 ? 0 : std::sqrt(squares / static_cast<double>(edges));
}

template <int D>
typename DisplacementPlan<D>::Next DisplacementPlan<D>::next(const Displacements<D>& coded,
                                                             const DisplacementPass& pass) const {
  const double step = static_cast<double>(pass.step) / Displacements<D>::kPerStep;
  double squares = 0;
  std::size_t edges = 0;
  Means<D> means(active_.size());
  forEachError(coded, [&](const Edge& edge, double error) {
    squares += error * error;
    ++edges;
    means.at(edge.positiveBrick, cubeOf<D>(edge.positiveBlock, pass.log2Side)).add(error);
  });
  Next next{Displacements<D>(active_.size()),
            edges == 0 ? 0 : std::sqrt(squares / static_cast<double>(edges))};
  for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
    const auto* of = means.find(brickIndex);
    if (of == nullptr) continue;
    std::transform(of->begin(), of->end(), next.steps.writable(brickIndex).begin(),
                   [&](const Mean& mean) { return mean.steps(step); });
  }
  return next;
}

template class DisplacementPlan<2>;
template class DisplacementPlan<3>;
template class DisplacementPlan<4>;

}  // namespace isostar
