// The field on an adaptive mesh (§5.3): the scalars of its leaves, octave by octave, for both directions, and what is shown of it.
#pragma once

#include "coding/adaptive/adaptive_mesh.h"
#include "coding/adaptive/adaptive_level.h"
#include "estimate/completion.h"
#include "coding/geometry/magnitude_coder.h"
#include "coding/geometry/exponent_coder.h"

namespace isostar {

/// An absent vertex lies on the refinement edge that it would split, halfway, and so does its scalar: the field is the
/// piecewise linear one of the leaves, whatever octave it is looked at, and no polygonizer can find a crack.
template <int D>
class AdaptiveField {
 public:
  explicit AdaptiveField(const Lattice<D>& base) : mesh(base) {}
  /// Of an octave that has been told in part, as AdaptiveMesh.
  AdaptiveField(Signs<D> coarse, Signs<D> fine, Signs<D> absent) : mesh(std::move(coarse), std::move(fine), std::move(absent)) {}

  AdaptiveMesh<D> mesh;
  Displacements<D> coarserDisplacements;  // of the octave before the last one, where no scalars are known
  Kernel kernel = Kernel::Middle, coarserKernel = Kernel::Middle;  // place the last octave's surface where no scalars are known, and others'

  /// Octaves whose scalars have been told.
  [[nodiscard]] int told() const { return static_cast<int>(octaves_.size()); }
  [[nodiscard]] const AdaptiveOctave<D>& octave(int level) const { return octaves_[static_cast<std::size_t>(level)]; }

  /// Bytes in use beside the models, while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = mesh.memory() + coarserDisplacements.memory();
    for (const auto& o : octaves_) sum += o.memory();
    return sum;
  }
  /// What it takes at most, on top of that, to begin the next octave's scalars.
  [[nodiscard]] uint64_t memoryToTell() const { return told() > mesh.level() ? 0 : memoryForNext(last(), told()); }

  /// Scalars of an octave: of the vertices of its leaves that coarser ones have not told. On the finest, `cubes` needs no
  /// ends of diagonals.
  template <class Exchange>
  void tellOctaves(Exchange& ask, int depth, Polygonizer polygonizer) {
    const int level = told();
    octaves_.push_back(next(last(), level));
    if (!coders_) coders_.emplace();
    auto& octave = octaves_.back();
    coders_->octaves.tell(ask, octave.signs, octave.scalars, Members::AxisEnds, depth, octave.active, [&](Tube<D>& tube) {
      if (level < mesh.level() || polygonizer == Polygonizer::Tetrahedra) tube.addDiagonalEnds(octave.signs);
      const auto& known = octave.scalars.at(tube.table().place(tube.at()));
      tube.keepOnly([&](std::size_t r, int x) {
        const std::size_t i = r * kBrickSide + static_cast<std::size_t>(x);
        return !known.knows(i) && mesh.belongsToLeaf(level, vertexOf<D>(tube.at(), i));
      });
    });
  }
  template <class Exchange>
  void tellHalvings(Exchange& ask, const typename HalvingCoder<D>::Pass& pass) {
    auto& octave = octaves_.back();
    coders_->halvings.tell(ask, octave.signs, octave.scalars, pass, octave.active);
  }

  /// The octave as it is known, with estimates where nothing has been told yet; nothing if that takes more bytes than given.
  [[nodiscard]] ISOSTAR_SELDOM std::optional<AdaptiveOctave<D>> shown(int level, uint64_t memory = UINT64_MAX) const {
    AdaptiveOctave<D> octave;
    for (int o = std::max(told() - 1, 0); o <= level; ++o) {
      const auto* coarser = o == 0 ? nullptr : &octave;
      const uint64_t made = o < told() ? this->octave(o).memory() : memoryForNext(coarser, o);
      if (octave.memory() + made > memory) return std::nullopt;
      if (o < told()) octave = this->octave(o);
      else octave = next(coarser, o);
      // Those known are copied while the others are estimated.
      const auto bricks = octave.scalars.brickCount() + static_cast<std::size_t>(std::count(octave.active.begin(), octave.active.end(), 1));
      if (octave.memory() + 2 * Scalars<D>::memoryOf(octave.active.size(), bricks) > memory) return std::nullopt;
      estimate(o, told() == 0 ? level - o : 0, octave);
    }
    return octave;
  }

 private:
  [[nodiscard]] const AdaptiveOctave<D>* last() const { return octaves_.empty() ? nullptr : &octaves_.back(); }
  [[nodiscard]] AdaptiveOctave<D> next(const AdaptiveOctave<D>* coarser, int level) const { return {mesh.signs(level), mesh.absent(level), coarser}; }
  [[nodiscard]] uint64_t memoryForNext(const AdaptiveOctave<D>* coarser, int level) const {
    return AdaptiveOctave<D>::memoryToMake(mesh.signs(level), mesh.absent(level), coarser);
  }

  /// Gives the vertices of an octave's leaves values, as many times larger as its steps are longer: those of other vertices
  /// are better estimated on finer octaves.
  ISOSTAR_SELDOM void estimate(int level, int finer, AdaptiveOctave<D>& octave) const {
    const Scalars<D> before = octave.scalars;
    const Hints<D> hints = level == mesh.level() ? Hints<D>{kernel} : Hints<D>{coarserKernel, level + 1 == mesh.level() ? &coarserDisplacements : nullptr};
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) estimateMissing(octave.signs, octave.active, members, finer, octave.scalars, hints);
    if (level == mesh.level()) return;
    const auto& table = octave.signs.table();
    for (std::size_t place = 0; place < table.total(); ++place) {
      if (!octave.scalars.has(place)) continue;
      auto& brick = octave.scalars.writable(place);
      for (std::size_t i = 0; i < Scalars<D>::kVertices; ++i) {
        if (!brick.knows(i) || before.at(place).knows(i) || mesh.belongsToLeaf(level, vertexOf<D>(table.brick(place), i))) continue;
        brick.value[i] = Scalars<D>::kUnknown;
      }
    }
  }

  std::vector<AdaptiveOctave<D>> octaves_;
  struct Coders {
    OctavesCoder<D> octaves;
    HalvingCoder<D> halvings;
  };
  std::optional<Coders> coders_;  // once scalars are told
};

}  // namespace isostar
