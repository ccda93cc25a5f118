// The traversal of an adapted mesh at a single rate (§5.1, adaptive): from each crossing leaf
// through its gates to the next, depth first.
#pragma once

#include "bisection/adjacency.h"
#include "coding/adaptive/mesh_exchange.h"
#include "coding/adaptive/seed_coder.h"
#include "entropy/models.h"

namespace isostar {

/// Codes the crossing leaves of a mesh of the RBMT and the signs of their vertices, each once.
///
/// In the paper a symbol {=, <, >} gives the depth of the leaf behind a gate. Depths of two leaves
/// that share a face differ by at most one. The leaf behind can be coarser only if the face lacks
/// its newest vertex (<), and finer only if the face lacks an end of its refinement edge (>). Both
/// are the same question: does the mesh have a certain vertex? It is coded once for all simplices
/// around that vertex's diamond.
template <int D>
class GateTraversal {
 public:
  explicit GateTraversal(const Hierarchy<D>& hierarchy)
      : mesh_(hierarchy),
        absent_(hierarchy.paddedLattice()),
        known_(Lattice<D>(hierarchy.box(), 1)),
        signs_(Lattice<D>(hierarchy.box(), 1)),
        seeds_(hierarchy) {}

  /// `exchange`: a MeshEncoderSide or a MeshDecoderSide. Calls visit(leaf, from, newVertex) for
  /// each crossing leaf when all its signs are known. The traversal entered it from *from, and its
  /// vertex number `newVertex` lies behind the gate. For the first leaf of a component `from` is
  /// null.
  template <class Exchange, class Visit>
  void code(Exchange& exchange, Visit visit) {
    auto seed = exchange.nextSeed(visited_);
    bool any = false;
    while (!seeds_.empty() && !exchange.exhausted() &&
           another_.bit(exchange.coder(), seed.has_value())) {
      any = true;
      component(exchange, seeds_.locate(exchange.coder(), seed), visit);
      seed = exchange.nextSeed(visited_);
    }
    if (!any)
      signs_.fill(uniform_.bit(exchange.coder(), exchange.positive({})) ? Signs<D>::kPositive
                                                                        : Signs<D>::kNegative);
  }

  /// Contains the coded leaves, and the splits that conformity requires beside them.
  [[nodiscard]] const Rbmt<D>& mesh() const { return mesh_; }
  /// The sign of a sample that is a vertex of a coded leaf; of any sample if there are no leaves.
  [[nodiscard]] bool positive(const Coordinates<D>& sample) const { return signs_.at(sample); }
  /// Is the sample a vertex of a coded leaf?
  [[nodiscard]] bool known(const Coordinates<D>& sample) const { return known_.at(sample); }
  [[nodiscard]] std::size_t leaves() const { return visited_.size(); }

 private:
  enum Relation { kCoarser, kFiner };
  struct Open {
    TaggedSimplex<D> leaf;
    int gate;  // the next face to examine
  };

  template <class Exchange, class Visit>
  void component(Exchange& exchange, const TaggedSimplex<D>& seed, Visit& visit) {
    for (auto ancestor = seed; ancestor.depth > 0;) {
      ancestor = parent(ancestor);
      mesh_.split(ancestor.middle(), scratch_);
    }
    for (const auto& v : seed.vertices) {
      settle(exchange, v, [&](bool actual) { return seedSign_.bit(exchange.coder(), actual); });
    }
    enter(seed);
    visit(seed, static_cast<const TaggedSimplex<D>*>(nullptr), 0);
    while (!stack_.empty() && !exchange.exhausted()) {
      Open& open = stack_.back();
      if (open.gate > D) {
        stack_.pop_back();
        continue;
      }
      const auto from = open.leaf;
      const int gate = open.gate++;
      if (!crossed(from, gate)) continue;
      const auto next = behind(exchange, from, gate);
      if (!next || visited_.has(next->simplex)) continue;
      settle(exchange, next->simplex.vertices[next->newVertex], [&](bool actual) {
        return sign(exchange.coder(), actual, from.vertices[gate], *next);
      });
      enter(next->simplex);
      visit(next->simplex, &from, next->newVertex);
    }
    stack_.clear();
  }

  void enter(const TaggedSimplex<D>& leaf) {
    visited_.insert(leaf);
    if (leaf.depth < mesh_.hierarchy().maxDepth()) absent_.set(leaf.middle(), true);
    stack_.push_back({leaf, 0});
  }

  [[nodiscard]] bool positiveVertex(const Coordinates<D>& v) const {
    return signs_.at(mesh_.hierarchy().position(v));
  }

  /// Does the face opposite a vertex have both signs?
  [[nodiscard]] bool crossed(const TaggedSimplex<D>& leaf, int opposite) const {
    int positives = 0;
    for (int i = 0; i <= D; ++i) positives += i != opposite && positiveVertex(leaf.vertices[i]);
    return positives != 0 && positives != D;
  }

  /// The leaf on the other side of a face, whatever its depth.
  template <class Exchange>
  std::optional<Adjacent<D>> behind(Exchange& exchange, const TaggedSimplex<D>& from, int gate) {
    const auto& hierarchy = mesh_.hierarchy();
    auto next = across(hierarchy, from, gate);
    if (!next) return next;
    auto& s = next->simplex;
    if (s.depth > 0 && next->newVertex == newest(s) &&
        !contains(exchange, s.vertices[next->newVertex], kCoarser)) {
      const auto coarse = parent(s);
      next->newVertex = coarse.vertices[0] == s.vertices[0] ? coarse.tag : 0;
      s = coarse;
    } else if (s.depth < hierarchy.maxDepth() &&
               (next->newVertex == 0 || next->newVertex == s.tag) &&
               contains(exchange, s.middle(), kFiner)) {
      const bool atEvenEnd = next->newVertex != 0;
      next->newVertex = s.tag;
      s = s.halves()[atEvenEnd ? 0 : 1];
    }
    return next;
  }

  /// Does the mesh have the vertex? Codes the symbol of {=, <, >} unless it follows from what is
  /// known.
  template <class Exchange>
  bool contains(Exchange& exchange, const Coordinates<D>& v, Relation relation) {
    if (mesh_.contains(v)) return true;
    mesh_.missing(v, scratch_);
    for (const auto& u : scratch_) {
      if (absent_.at(u)) return false;
    }
    const bool there = depth(exchange.coder(), exchange.contains(v), v, relation);
    if (there) {
      mesh_.split(v, scratch_);
    } else {
      absent_.set(v, true);
    }
    return there;
  }

  /// Codes the symbol. Contexts: the vertex's depth, what is known of the vertices of the same
  /// class beside it, and the last symbols.
  template <class Coder>
  bool depth(Coder& coder, bool actual, const Coordinates<D>& v, Relation relation) {
    const auto d = mesh_.hierarchy().diamond(v);
    const auto lattice = absent_.lattice();
    std::size_t there = 0, absent = 0;
    for (int a = 0; a < D; ++a) {
      for (int32_t by : {-2 * d.half, 2 * d.half}) {
        auto beside = v;
        beside[a] += by;
        if (beside[a] < 0 || beside[a] > lattice.last[a]) continue;
        there += mesh_.contains(beside);
        absent += absent_.at(beside);
      }
    }
    const auto kind =
        static_cast<std::size_t>(relation) * D + static_cast<std::size_t>(d.axes() - 1);
    const std::array<BitModel*, 3> contexts{
        &depthByDepth_[kind]
                      [std::min<std::size_t>(static_cast<std::size_t>(d.depth), kMostDepths - 1)],
        &depthBySides_[kind][there][absent], &depthByLast_[kind][lastDepths_]};
    const bool value = Mixer<3>::bit<127, 12>(coder, actual, contexts, depthWeights_[kind]);
    lastDepths_ = (lastDepths_ << 1 | (value ? 1u : 0u)) & (kHistories - 1);
    return value;
  }

  template <class Exchange, class Code>
  void settle(Exchange& exchange, const Coordinates<D>& v, Code code) {
    const auto sample = mesh_.hierarchy().position(v);
    if (known_.at(sample)) return;
    known_.set(sample, true);
    signs_.set(sample, code(exchange.positive(sample)));
  }

  /// Codes the sign of the vertex behind a gate. Contexts: the signs of the gate and of the vertex
  /// before it, and the samples around.
  template <class Coder>
  bool sign(Coder& coder, bool actual, const Coordinates<D>& before, const Adjacent<D>& next) {
    const auto& s = next.simplex;
    std::size_t pattern = positiveVertex(before) ? 1 : 0;
    for (int i = 0; i <= D; ++i) {
      if (i != next.newVertex) pattern = pattern << 1 | (positiveVertex(s.vertices[i]) ? 1u : 0u);
    }
    const auto at = mesh_.hierarchy().position(s.vertices[next.newVertex]);
    const int32_t step = shortestStep(s);
    std::size_t around = 0, sum = 2 * D, count = 0;
    for (int a = 0; a < D; ++a) {
      for (int32_t by : {-step, step}) {
        auto beside = at;
        beside[a] = std::clamp(beside[a] + by, 0, mesh_.hierarchy().box()[a]);
        const bool seen = known_.at(beside) && beside != at, positive = seen && signs_.at(beside);
        around = 3 * around + (seen ? 1u + positive : 0u);
        sum += seen ? (positive ? 1u : std::size_t(-1)) : 0u;
        count += seen;
      }
    }
    const auto tag = static_cast<std::size_t>(s.tag - 1),
               newVertex = static_cast<std::size_t>(next.newVertex);
    const std::array<BitModel*, 3> contexts{&signByGate_[tag][newVertex][pattern],
                                            &signByAround_[around], &signBySum_[tag][sum][count]};
    return Mixer<3>::bit<127, 12>(coder, actual, contexts, signWeights_[tag]);
  }
  /// The shortest distance between two of the simplex's vertices along an axis.
  [[nodiscard]] int32_t shortestStep(const TaggedSimplex<D>& s) const {
    return mesh_.hierarchy().baseStep() >> ((s.depth + D - 1) / D);
  }

  static constexpr std::size_t kMostDepths = 64, kHistories = 16, kSides = 2 * D + 1;

  Rbmt<D> mesh_;
  Signs<D> absent_;         // vertices that are known not to be in the mesh
  Signs<D> known_, signs_;  // by sample
  LeafSet<D> visited_;
  std::vector<Open> stack_;
  typename Rbmt<D>::Vertices scratch_;

  SeedCoder<D> seeds_;
  BitModel another_, uniform_, seedSign_;
  std::array<std::array<BitModel, kMostDepths>, 2 * D> depthByDepth_;
  std::array<std::array<std::array<BitModel, kSides>, kSides>, 2 * D> depthBySides_;
  std::array<std::array<BitModel, kHistories>, 2 * D> depthByLast_;
  std::size_t lastDepths_ = 0;
  std::array<std::array<std::array<BitModel, (1u << (D + 1))>, D + 1>, D> signByGate_;
  std::array<BitModel, power(3, 2 * D)> signByAround_;
  std::array<std::array<std::array<BitModel, kSides>, 2 * kSides>, D> signBySum_;
  std::array<Mixer<3>::Weights, 2 * D> depthWeights_ = weights<2 * D>();
  std::array<Mixer<3>::Weights, D> signWeights_ = weights<D>();

  template <std::size_t N>
  static std::array<Mixer<3>::Weights, N> weights() {
    std::array<Mixer<3>::Weights, N> all;
    all.fill(Mixer<3>::initialWeights());
    return all;
  }
};

}  // namespace isostar
