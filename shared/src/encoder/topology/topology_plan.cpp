// Finds the cells that can be kept, from the welds that preserve the topology.
#include "encoder/topology/topology_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bisection/weld_topology.h"
#include "grid/refined_signs.h"

namespace isostar {
namespace {

template <int D, class Visit>
void forEachAround(const Lattice<D>& lattice, const Coordinates<D>& v, Visit visit) {
  Coordinates<D> low, high;
  for (int a = 0; a < D; ++a) {
    low[a] = std::max(v[a] - 1, 0);
    high[a] = std::min(v[a] + 1, lattice.last[a]);
  }
  forEachBetween<D>(low, high, visit);
}

/// Does a vertex lie in or beside a cell that is too short to be halved?
template <int D>
bool besideShortEnd(const Lattice<D>& lattice, const Coordinates<D>& v) {
  for (int a = 0; a < D; ++a) {
    const bool odd = (lattice.last[a] & 1) != 0;
    if (odd && v[a] + (lattice.isNew(a, v[a]) ? 1 : 0) >= lattice.last[a] - 1) return true;
  }
  return false;
}

/// Calls visit(v) for each vertex of a brick that lies in the lattice.
template <int D, class Visit>
void forEachInBrick(const Signs<D>& signs, std::size_t brickIndex, Visit visit) {
  Coordinates<D> low = signs.table().brick(brickIndex), high;
  for (int a = 0; a < D; ++a) {
    low[a] *= kBrickSide;
    high[a] = std::min(low[a] + kBrickSide - 1, signs.lattice().last[a]);
  }
  forEachBetween<D>(low, high, visit);
}

}  // namespace

template <int D>
TopologyPlan<D>::TopologyPlan(const std::vector<Signs<D>>& actual) : actual_(actual) {
  for (int level = 0; level <= finestLevel(); ++level) {
    const auto& signs = actual_[static_cast<std::size_t>(level)];
    changing_.emplace_back(signs.lattice());
    forbidden_.emplace_back(signs.lattice());
    centres_.emplace_back(signs.lattice());
    if (level == 0) continue;
    const auto active = activeBricks(signs);
    for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
      if (active[brickIndex] == 0) continue;
      forEachInBrick(signs, brickIndex, [&](const Coordinates<D>& v) {
        if (signs.lattice().newAxes(v) != 0 && !keepsTopology(level, v))
          changing_.back().set(v, true);
      });
    }
  }
  update();
}

template <int D>
bool TopologyPlan<D>::keepsTopology(int level, const Coordinates<D>& v) const {
  const auto& signs = actual_[static_cast<std::size_t>(level)];
  const auto& lattice = signs.lattice();
  const bool sign = signs.at(v);
  if (besideShortEnd<D>(lattice, v)) {
    bool same = true;
    forEachAround<D>(lattice, v,
                     [&](const Coordinates<D>& w) { same = same && signs.at(w) == sign; });
    return same;
  }
  const Hierarchy<D> hierarchy(lattice.last, 1);
  return weldKeepsTopology(
      hierarchy, v, [&](const Coordinates<D>& w) { return signs.at(hierarchy.position(w)); });
}

/// A vertex depends on all corners of the coarser level's cells that it lies in.
template <int D>
void TopologyPlan<D>::pinParents(const Signs<D>& bad, Signs<D>& parents) const {
  const auto& lattice = bad.lattice();
  forEachMember(bad, [&](const Coordinates<D>& v) {
    Coordinates<D> low, high;
    for (int a = 0; a < D; ++a) {
      const int32_t parent = lattice.parent(a, v[a]);
      const bool isNew = lattice.isNew(a, v[a]);
      low[a] = std::max(parent - (isNew ? 0 : 1), 0);
      high[a] = std::min(parent + 1, parents.lattice().last[a]);
    }
    forEachBetween<D>(low, high, [&](const Coordinates<D>& w) { parents.set(w, true); });
  });
}

template <int D>
Signs<D> TopologyPlan<D>::wholeCells(int level, const Signs<D>& bad) const {
  const auto& signs = actual_[static_cast<std::size_t>(level)];
  const auto& lattice = signs.lattice();
  Signs<D> centres(lattice);
  const auto active = activeBricks(signs);
  for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
    if (active[brickIndex] == 0) continue;
    forEachInBrick(signs, brickIndex, [&](const Coordinates<D>& v) {
      if (lattice.newAxes(v) != (1u << D) - 1) return;
      bool whole = true;
      forEachAround<D>(lattice, v, [&](const Coordinates<D>& w) { whole = whole && !bad.at(w); });
      if (whole) centres.set(v, true);
    });
  }
  return centres;
}

template <int D>
void TopologyPlan<D>::update() {
  Signs<D> pinned(actual_.back().lattice());
  for (std::size_t level = actual_.size(); level-- > 1;) {
    Signs<D> bad = std::move(pinned);
    for (const auto* more : {&changing_[level], &forbidden_[level]})
      forEachMember(*more, [&](const Coordinates<D>& v) { bad.set(v, true); });
    centres_[level] = wholeCells(static_cast<int>(level), bad);
    pinned = Signs<D>(actual_[level - 1].lattice());
    pinParents(bad, pinned);
  }
}

template <int D>
bool TopologyPlan<D>::forbid(const Coordinates<D>& v, int level, double reach) {
  for (int finer = level; finer <= finestLevel(); ++finer) {
    const auto& centres = centres_[static_cast<std::size_t>(finer)];
    const auto& lattice = centres.lattice();
    Coordinates<D> low, high;
    // From a cell's centre.
    const auto around = static_cast<int32_t>(std::ceil((1 + 2 * reach) * lattice.step));
    for (int a = 0; a < D; ++a) {
      low[a] = std::clamp((v[a] - around) / lattice.step, 0, lattice.last[a]);
      high[a] = std::clamp((v[a] + around) / lattice.step, 0, lattice.last[a]);
    }
    bool any = false;
    forEachBetween<D>(low, high, [&](const Coordinates<D>& w) {
      if (!centres.at(w)) return;
      forbidden_[static_cast<std::size_t>(finer)].set(w, true);
      any = true;
    });
    if (any) return true;
  }
  return false;
}

template class TopologyPlan<3>;

}  // namespace isostar
