// An adapted mesh at a single rate (§5.1, adaptive): from each crossing leaf through its gates to the next, depth
// first.
#pragma once

#include "bisection/adjacency.h"
#include "coding/adaptive/mesh_exchange.h"
#include "entropy/models.h"
#include "coding/adaptive/seed_coder.h"

namespace isostar {

/// Tells the crossing leaves of a mesh of the RBMT and the signs of their vertices, each once.
///
/// The level of the leaf behind a gate is {=, <, >} in the paper. Two leaves that share a face differ by a level at
/// most, and by which only where the face lacks the newest vertex (<) or an end of the refinement edge (>); either is
/// one question, whether the mesh has a vertex, and that is asked once for all simplices around the vertex's diamond.
template <int D>
class GateTraversal {
 public:
  explicit GateTraversal(const Hierarchy<D>& hierarchy)
      : mesh_(hierarchy),
        absent_(hierarchy.paddedLattice()),
        known_(Lattice<D>(hierarchy.box(), 1)),
        signs_(Lattice<D>(hierarchy.box(), 1)),
        seeds_(hierarchy) {}

  /// `ask` is a MeshTruth or a MeshBlind. Calls visit(leaf, from, fresh) for each crossing leaf when all its signs are
  /// known: it was entered from *from and its vertex `fresh` lies behind the gate; a component's first leaf has no
  /// `from`.
  template <class Ask, class Visit>
  void tell(Ask& ask, Visit visit) {
    auto seed = ask.nextSeed(visited_);
    bool any = false;
    while (!seeds_.empty() && !ask.spent() && another_.bit(ask.coder(), seed.has_value())) {
      any = true;
      component(ask, seeds_.locate(ask.coder(), seed), visit);
      seed = ask.nextSeed(visited_);
    }
    if (!any) signs_.fill(uniform_.bit(ask.coder(), ask.positive({})) ? Signs<D>::kPositive : Signs<D>::kNegative);
  }

  /// Has the leaves told, and what conforming asks for beside them.
  [[nodiscard]] const Rbmt<D>& mesh() const { return mesh_; }
  /// Of a sample that is a vertex of a leaf told; of any if there was none.
  [[nodiscard]] bool positive(const Coordinates<D>& sample) const { return signs_.at(sample); }
  /// Is the sample a vertex of a leaf told?
  [[nodiscard]] bool known(const Coordinates<D>& sample) const { return known_.at(sample); }
  [[nodiscard]] std::size_t leaves() const { return visited_.size(); }

 private:
  enum Relation { kCoarser, kFiner };
  struct Open {
    TaggedSimplex<D> leaf;
    int gate;  // the next face to look at
  };

  template <class Ask, class Visit>
  void component(Ask& ask, const TaggedSimplex<D>& seed, Visit& visit) {
    for (auto ancestor = seed; ancestor.level > 0;) {
      ancestor = parent(ancestor);
      mesh_.split(ancestor.middle(), scratch_);
    }
    for (const auto& v : seed.vertices) {
      settle(ask, v, [&](bool truth) { return seedSign_.bit(ask.coder(), truth); });
    }
    enter(seed);
    visit(seed, static_cast<const TaggedSimplex<D>*>(nullptr), 0);
    while (!stack_.empty() && !ask.spent()) {
      Open& open = stack_.back();
      if (open.gate > D) {
        stack_.pop_back();
        continue;
      }
      const auto from = open.leaf;
      const int gate = open.gate++;
      if (!crossed(from, gate)) continue;
      const auto next = behind(ask, from, gate);
      if (!next || visited_.has(next->simplex)) continue;
      settle(ask, next->simplex.vertices[next->fresh],
             [&](bool truth) { return sign(ask.coder(), truth, from.vertices[gate], *next); });
      enter(next->simplex);
      visit(next->simplex, &from, next->fresh);
    }
    stack_.clear();
  }

  void enter(const TaggedSimplex<D>& leaf) {
    visited_.insert(leaf);
    if (leaf.level < mesh_.hierarchy().levels()) absent_.set(leaf.middle(), true);
    stack_.push_back({leaf, 0});
  }

  [[nodiscard]] bool positiveVertex(const Coordinates<D>& v) const { return signs_.at(mesh_.hierarchy().position(v)); }

  /// Has the face opposite a vertex both signs?
  [[nodiscard]] bool crossed(const TaggedSimplex<D>& leaf, int opposite) const {
    int positives = 0;
    for (int i = 0; i <= D; ++i) positives += i != opposite && positiveVertex(leaf.vertices[i]);
    return positives != 0 && positives != D;
  }

  /// The leaf on the other side of a face, whatever its level.
  template <class Ask>
  std::optional<Adjacent<D>> behind(Ask& ask, const TaggedSimplex<D>& from, int gate) {
    const auto& hierarchy = mesh_.hierarchy();
    auto next = across(hierarchy, from, gate);
    if (!next) return next;
    auto& s = next->simplex;
    if (s.level > 0 && next->fresh == newest(s) && !contains(ask, s.vertices[next->fresh], kCoarser)) {
      const auto coarse = parent(s);
      next->fresh = coarse.vertices[0] == s.vertices[0] ? coarse.tag : 0;
      s = coarse;
    } else if (s.level < hierarchy.levels() && (next->fresh == 0 || next->fresh == s.tag) &&
               contains(ask, s.middle(), kFiner)) {
      const bool atEvenEnd = next->fresh != 0;
      next->fresh = s.tag;
      s = s.halves()[atEvenEnd ? 0 : 1];
    }
    return next;
  }

  /// Has the mesh the vertex? The symbol of {=, <, >}, where it does not follow from what is known.
  template <class Ask>
  bool contains(Ask& ask, const Coordinates<D>& v, Relation relation) {
    if (mesh_.contains(v)) return true;
    mesh_.missing(v, scratch_);
    for (const auto& u : scratch_) {
      if (absent_.at(u)) return false;
    }
    const bool there = level(ask.coder(), ask.contains(v), v, relation);
    if (there) {
      mesh_.split(v, scratch_);
    } else {
      absent_.set(v, true);
    }
    return there;
  }

  /// In context of what is known of the vertices of the same class beside it, and of the last answers.
  template <class Coder>
  bool level(Coder& coder, bool truth, const Coordinates<D>& v, Relation relation) {
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
    const auto kind = static_cast<std::size_t>(relation) * D + static_cast<std::size_t>(d.axes() - 1);
    const std::array<Chance*, 3> contexts{
        &levelByLevel_[kind][std::min<std::size_t>(static_cast<std::size_t>(d.level), kMostLevels - 1)],
        &levelBySides_[kind][there][absent], &levelByLast_[kind][lastLevels_]};
    const bool value = Mixer<3>::bit<127, 12>(coder, truth, contexts, levelWeights_[kind]);
    lastLevels_ = (lastLevels_ << 1 | (value ? 1u : 0u)) & (kHistories - 1);
    return value;
  }

  template <class Ask, class Tell>
  void settle(Ask& ask, const Coordinates<D>& v, Tell tell) {
    const auto sample = mesh_.hierarchy().position(v);
    if (known_.at(sample)) return;
    known_.set(sample, true);
    signs_.set(sample, tell(ask.positive(sample)));
  }

  /// Of the vertex behind a gate, in context of the gate and the vertex before it, and of the samples around.
  template <class Coder>
  bool sign(Coder& coder, bool truth, const Coordinates<D>& before, const Adjacent<D>& next) {
    const auto& s = next.simplex;
    std::size_t pattern = positiveVertex(before) ? 1 : 0;
    for (int i = 0; i <= D; ++i) {
      if (i != next.fresh) pattern = pattern << 1 | (positiveVertex(s.vertices[i]) ? 1u : 0u);
    }
    const auto at = mesh_.hierarchy().position(s.vertices[next.fresh]);
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
    const auto tag = static_cast<std::size_t>(s.tag - 1), fresh = static_cast<std::size_t>(next.fresh);
    const std::array<Chance*, 3> contexts{&signByGate_[tag][fresh][pattern], &signByAround_[around],
                                          &signBySum_[tag][sum][count]};
    return Mixer<3>::bit<127, 12>(coder, truth, contexts, signWeights_[tag]);
  }
  /// Between the simplex's vertices, along an axis.
  [[nodiscard]] int32_t shortestStep(const TaggedSimplex<D>& s) const {
    return mesh_.hierarchy().baseStep() >> ((s.level + D - 1) / D);
  }

  static constexpr std::size_t kMostLevels = 64, kHistories = 16, kSides = 2 * D + 1;

  Rbmt<D> mesh_;
  Signs<D> absent_;         // vertices that the mesh is known not to have
  Signs<D> known_, signs_;  // by sample
  LeafSet<D> visited_;
  std::vector<Open> stack_;
  typename Rbmt<D>::Vertices scratch_;

  SeedCoder<D> seeds_;
  Chance another_, uniform_, seedSign_;
  std::array<std::array<Chance, kMostLevels>, 2 * D> levelByLevel_;
  std::array<std::array<std::array<Chance, kSides>, kSides>, 2 * D> levelBySides_;
  std::array<std::array<Chance, kHistories>, 2 * D> levelByLast_;
  std::size_t lastLevels_ = 0;
  std::array<std::array<std::array<Chance, (1u << (D + 1))>, D + 1>, D> signByGate_;
  std::array<Chance, power(3, 2 * D)> signByAround_;
  std::array<std::array<std::array<Chance, kSides>, 2 * kSides>, D> signBySum_;
  std::array<Mixer<3>::Weights, 2 * D> levelWeights_ = weights<2 * D>();
  std::array<Mixer<3>::Weights, D> signWeights_ = weights<D>();

  template <std::size_t N>
  static std::array<Mixer<3>::Weights, N> weights() {
    std::array<Mixer<3>::Weights, N> all;
    all.fill(Mixer<3>::fresh());
    return all;
  }
};

}  // namespace isostar
