// Uniform refinement (§5.2): D bisections lead from one octave to the next; at each the signs of the new vertices are told.
#pragma once

#include "exchange.h"
#include "neighbourhood.h"
#include "octave.h"
#include "seldom.h"

namespace isostar {

/// Tells an octave's fresh vertices, by the number of axes on which they are fresh: D (centres of cells), … 1 (midpoints
/// of their edges). A vertex whose diamond has both signs is told by a decision in context. One whose diamond is
/// uniform has its sign deduced, unless a component of the surface first appears there: these exceptions are localized
/// by brick, row and vertex, so that the octave's signs are the source's, every component and no more.
template <int D>
class RefinementCoder {
 public:
  ISOSTAR_SELDOM RefinementCoder() {
    uint32_t near = 0, counted = 0;
    for (unsigned set = 1; set < kSets; ++set) {
      const auto& n = neighbourhoods_[set];
      const unsigned first = (1u << std::popcount(set)) - 1;  // of those with as many axes, which share all but near_
      const int diamondBits = std::min(n.diamondCount(), Nearby::kDiamondBits), siblings = std::min(kSiblings, kMostNearBits - diamondBits);
      tables_[set] = {near, set == first ? counted : tables_[first].counted, siblings};
      near += 1u << (diamondBits + siblings);
      if (set == first) counted += static_cast<uint32_t>((n.cornerCount + 1) * (n.acrossCount + 1));
    }
    near_.resize(near);
    counts_.resize(counted << kSiblings);
    wide_.resize(counted << kWideBits);
    weights_.resize(counted, Mixer<kInputs>::freshWithEstimate());
  }

  /// All bisections of an octave, slab of bricks by slab: each bisection follows the one before a slab behind, where all
  /// that it looks at has been told, so that of a stream that ends early all before a few places is known. Of an adaptive octave (§5.2)
  /// `absent` are the vertices that are not in the mesh: the first bisection tells of each crossing cell whether it stays
  /// whole, and a vertex whose diamond has an absent one is absent too, so that the mesh conforms.
  template <class Exchange>
  void tell(Exchange& ask, Signs<D>& signs, Signs<D>* absent = nullptr) {
    absent_ = absent;
    active_ = activeBricks(signs);
    if (absent != nullptr) {
      const auto near = activeBricks(*absent);
      for (std::size_t place = 0; place < near.size(); ++place) active_[place] |= near[place];
    }
    told_.fill(0);
    const auto slabs = static_cast<std::size_t>(signs.table().count(D - 1));
    for (std::size_t step = 0; step < slabs + D - 1; ++step) {
      for (int dimension = D; dimension >= 1; --dimension) {
        const std::size_t slab = step + static_cast<std::size_t>(dimension) - D;  // wraps around before the first
        if (slab >= slabs) continue;
        bisect(ask, signs, dimension, slab);
        if (ask.spent(signs.memory() + memory())) return;
      }
    }
  }

  /// Of an octave that has been told in part: the fresh vertices near the surface that have not.
  [[nodiscard]] ISOSTAR_SELDOM Signs<D> untold(const Signs<D>& signs) const {
    Signs<D> result(signs.lattice());
    for (std::size_t place = 0; place < active_.size(); ++place) {
      if (active_[place] == 0) continue;
      forEachFresh(signs.lattice(), signs.table().brick(place), [&](const Coordinates<D>& v, std::size_t dimension) {
        if (place >= told_[dimension]) result.set(v, true);
      });
    }
    return result;
  }
  /// The bricks of the octave told last that touch the surface, and a few others, 1 marked, by place; none the second time.
  [[nodiscard]] std::vector<uint8_t> takeActive() { return std::move(active_); }
  /// Has any of the octave been told?
  [[nodiscard]] bool began() const { return told_[D] != 0; }

  /// The absent vertices of an octave that are fresh on `dimension` axes, D first: all coarser ones are there by now, and a
  /// fresh one has its lower corner's sign for now. No component first appears here, or its vertices would not be absent.
  template <class Exchange>
  ISOSTAR_SELDOM void fill(Exchange& ask, Signs<D>& signs, int dimension, const Signs<D>& absent) {
    absent_ = nullptr;
    for (std::size_t place = 0; place < signs.table().total() && !ask.spent(signs.memory() + memory()); ++place) {
      if (absent.index(place) == Signs<D>::kNegative) continue;
      enter(signs, place, dimension);
      for (int i = 0; i < openCount_; ++i) {
        Row& row = rows_[open_[static_cast<std::size_t>(i)]];
        row.open = static_cast<uint8_t>(row.open & absent.brickAt(place).rows[row.brick]);
        tellRow(ask, place, row);
      }
      if (changed_) store(signs, place);
    }
    changedPlaces_.clear();
  }

  /// Bytes in use beside the models, while one more place changes.
  [[nodiscard]] uint64_t memory() const { return active_.capacity() + memoryToGrow(changedPlaces_) + memoryToGrow(absentPlaces_); }

 private:
  static constexpr int kInputs = 3;
  static constexpr int kMostNearBits = 14, kSiblings = 7, kWideBits = 8;
  static constexpr unsigned kSets = 1u << D;
  static constexpr std::size_t kGroup = 64;  // quiet bricks in a row that share a flag
  static constexpr std::size_t kBrickRows = power(kBrickSide, D - 1);
  using Bits = uint32_t;
  using Nearby = Neighbourhood<D>;

  /// One bisection of a slab: tells the vertices fresh on `dimension` axes.
  template <class Exchange>
  void bisect(Exchange& ask, Signs<D>& signs, int dimension, std::size_t slab) {
    const std::size_t size = signs.table().stride(D - 1), begin = slab * size, end = begin + size;
    for (std::size_t first = begin; first < end && !ask.spent(signs.memory() + memory()); first += kGroup) {
      quietGroup(ask, signs, dimension, first, std::min(first + kGroup, end));
    }
    std::size_t& told = told_[static_cast<std::size_t>(dimension)];
    for (std::size_t place = begin; place < end && !ask.spent(signs.memory() + memory()); ++place) {
      told = place;
      if (active_[place] != 0) brick(ask, signs, place, dimension);
    }
    if (!ask.spent(signs.memory() + memory())) told = end;  // else what was read of the last brick may be noise
    for (const std::size_t place : changedPlaces_) activateAround(signs, place, active_);
    changedPlaces_.clear();
    for (const std::size_t place : absentPlaces_) activateAround(*absent_, place, active_);
    absentPlaces_.clear();
  }

  /// Calls visit(v, on how many axes it is fresh) for the fresh vertices of a brick.
  template <class Visit>
  ISOSTAR_SELDOM static void forEachFresh(const Lattice<D>& lattice, const Coordinates<D>& brick, Visit visit) {
    Coordinates<D> low, high;
    for (int a = 0; a < D; ++a) {
      low[a] = brick[a] * kBrickSide;
      high[a] = std::min(low[a] + kBrickSide - 1, lattice.last[a]);
    }
    forEachBetween<D>(low, high, [&](const Coordinates<D>& v) {
      std::size_t dimension = 0;
      for (int a = 0; a < D; ++a) dimension += lattice.fresh(a, v[a]) ? 1 : 0;
      if (dimension != 0) visit(v, dimension);
    });
  }

  /// By the set of fresh axes; made once, at run time, since the tables would be a large part of a small decoder.
  static const std::array<Neighbourhood<D>, kSets>& neighbourhoods() {
    static const std::array<Neighbourhood<D>, kSets> kAll = [] {
      std::array<Neighbourhood<D>, kSets> all{};
      for (unsigned o = 1; o < kSets; ++o) all[o] = Neighbourhood<D>(o);
      return all;
    }();
    return kAll;
  }

  /// A row of a brick with vertices of the class.
  struct Row {
    int16_t window;   // in the Window
    uint16_t brick;   // in the Brick
    uint8_t fresh;    // the axes on which its vertices are fresh
    uint8_t members;  // its vertices of the class
    uint8_t open;     // those whose diamond has both signs
    uint8_t absent;   // those that are not in the mesh
  };

  /// Components that first appear far from the surface.
  template <class Exchange>
  void quietGroup(Exchange& ask, Signs<D>& signs, int dimension, std::size_t first, std::size_t end) {
    bool any = false, quiet = false;
    for (std::size_t place = first; place < end; ++place) {
      if (active_[place] != 0) continue;
      quiet = true;
      any = any || differs(ask, signs, place, dimension);
    }
    if (!quiet || !groupFlag_[dimension].bit(ask.coder(), any)) return;
    for (std::size_t place = first; place < end && !ask.spent(signs.memory() + memory()); ++place) {
      if (active_[place] != 0 || !quietFlag_[dimension].bit(ask.coder(), differs(ask, signs, place, dimension))) continue;
      enter(signs, place, dimension);
      tellExceptions(ask, place, 0);
      store(signs, place);
    }
  }

  /// Which crossing cells of a brick stay whole, by those before.
  template <class Exchange>
  void tellWhole(Exchange& ask, std::size_t place) {
    for (int i = 0; i < openCount_; ++i) {
      Row& row = rows_[open_[static_cast<std::size_t>(i)]];
      const auto& n = neighbourhoods_[row.fresh];
      const Bits truth = ask.keptRow(place, row.brick);
      uint16_t& absent = absentWindow_.rows[row.window];
      for (Bits open = row.open; open != 0; open &= open - 1) {
        const int x = std::countr_zero(open), at = x + Window<D>::kHalo;
        const auto packs = RowPacks<D>::around(&absent);
        const unsigned siblings = packs.count(n.siblingMask, at), far = packs.count(n.outerMask, at);
        Chance& chance = whole_[std::min(siblings, 7u) * 4 + (far == 0 ? 0 : far < 4 ? 1 : far < 12 ? 2 : 3)];
        if (!chance.bit(ask.coder(), (truth >> x & 1) != 0)) continue;
        absent = static_cast<uint16_t>(absent | 1u << at);
        row.absent = static_cast<uint8_t>(row.absent | 1u << x);
      }
      row.open = static_cast<uint8_t>(row.open & ~row.absent);
    }
  }

  void storeAbsent(std::size_t place) {
    Bits any = 0;
    for (int i = 0; i < rowCount_; ++i) any |= rows_[i].absent;
    if (any == 0) return;
    absentPlaces_.push_back(place);
    auto& rows = absent_->writable(place).rows;
    for (int i = 0; i < rowCount_; ++i) rows[rows_[i].brick] = static_cast<uint8_t>(rows[rows_[i].brick] | rows_[i].absent);
  }

  template <class Exchange>
  bool differs(Exchange& ask, const Signs<D>& signs, std::size_t place, int dimension) {
    if (!ask.varies(place, signs.index(place))) return false;
    findRows(signs.lattice(), signs.table().brick(place), dimension);
    const Bits uniform = signs.index(place) == Signs<D>::kPositive ? 0xFF : 0;
    Bits difference = 0;
    for (int i = 0; i < rowCount_; ++i) difference |= (ask.row(place, rows_[i].brick) ^ uniform) & rows_[i].members;
    return difference != 0;
  }

  template <class Exchange>
  void brick(Exchange& ask, Signs<D>& signs, std::size_t place, int dimension) {
    enter(signs, place, dimension);
    if (absent_ != nullptr) {
      if (dimension == D) tellWhole(ask, place);
      storeAbsent(place);
    }
    int told = 0;
    for (int i = 0; i < openCount_; ++i) told += tellRow(ask, place, rows_[open_[static_cast<std::size_t>(i)]]);
    if (brickFlag_[dimension][activity(told)].bit(ask.coder(), hasExceptions(ask, place))) tellExceptions(ask, place, activity(told));
    if (changed_) store(signs, place);
  }

  void enter(const Signs<D>& signs, std::size_t place, int dimension) {
    const auto at = signs.table().brick(place);
    changed_ = false;
    window_.load(signs, at);
    findRows(signs.lattice(), at, dimension);
    if (absent_ != nullptr) absentWindow_.load(*absent_, at);
    openCount_ = 0;
    // Of eight rows along axis 1, those on its fresh planes have the same axes, and the others have.
    std::array<typename Window<D>::Rows, 2> crossed{};
    std::array<int, 2> eights{-1, -1};
    for (int i = 0; i < rowCount_; ++i) {
      const std::size_t kind = rows_[i].fresh >> 1 & 1;
      const int eight = rows_[i].brick / kBrickSide, row = rows_[i].brick % kBrickSide;
      if (eights[kind] != eight) crossed[kind] = crossing(rows_[i].window - row, rows_[i].fresh);
      eights[kind] = eight;
      rows_[i].absent = absent_ == nullptr ? uint8_t{0} : static_cast<uint8_t>(besideAbsent(rows_[i]) & rows_[i].members);
      rows_[i].open = static_cast<uint8_t>(crossed[kind][row] & rows_[i].members & ~rows_[i].absent);
      open_[static_cast<std::size_t>(openCount_)] = static_cast<uint16_t>(i);
      openCount_ += rows_[i].open != 0 ? 1 : 0;
    }
  }

  /// The rows of a brick that have vertices of the class: in all bricks but the last ones the same.
  void findRows(const Lattice<D>& lattice, const Coordinates<D>& at, int dimension) {
    bool last = false;
    for (int a = 0; a < D; ++a) last = last || (at[a] + 1) * kBrickSide > lattice.last[a];
    const int kind = last ? -1 : dimension;
    if (!last && rowKind_ == kind) return;
    rowKind_ = kind;
    Bits fresh = 0, inside = 0;
    for (int x = 0; x < kBrickSide && at[0] * kBrickSide + x <= lattice.last[0]; ++x) {
      inside |= 1u << x;
      if (lattice.fresh(0, at[0] * kBrickSide + x)) fresh |= 1u << x;
    }
    rowCount_ = 0;
    Coordinates<D> v{};
    for (std::size_t r = 0; r < kBrickRows; ++r) {
      unsigned o = 0;
      bool in = true;
      for (int a = 1; a < D; ++a) {
        const int32_t plane = at[a] * kBrickSide + v[a];
        in = in && plane <= lattice.last[a];
        if (lattice.fresh(a, plane)) o |= 1u << a;
      }
      const int left = dimension - std::popcount(o);
      const Bits members = left == 1 ? fresh : left == 0 ? inside & ~fresh : 0;
      if (in && members != 0) {
        rows_[rowCount_++] = {Window<D>::kOwnRows[r], static_cast<uint16_t>(r), static_cast<uint8_t>(o | static_cast<unsigned>(left)),
                              static_cast<uint8_t>(members), 0, 0};
      }
      for (int a = 1; a < D && ++v[a] == kBrickSide; ++a) v[a] = 0;
    }
  }

  /// Which vertices of eight rows have a diamond of both signs, if they are fresh on these axes: all at once.
  [[nodiscard]] typename Window<D>::Rows crossing(int first, unsigned fresh) const {
    const auto& n = neighbourhoods_[fresh];
    typename Window<D>::Rows some{}, all = ~some;
    for (int i = 0; i < n.diamondCount(); ++i) {
      const auto rows = window_.eightFrom(first + n.diamond[i].rows) >> (Window<D>::kHalo + n.diamond[i].bits);
      some |= rows;
      all &= rows;
    }
    return some & ~all;
  }

  /// Which vertices of a row have a diamond with a vertex that is not in the mesh.
  [[nodiscard]] Bits besideAbsent(const Row& row) const {
    const auto& n = neighbourhoods_[row.fresh];
    Bits any = 0;
    for (int i = 0; i < n.diamondCount(); ++i) {
      any |= static_cast<Bits>(absentWindow_.rows[row.window + n.diamond[i].rows]) >> (Window<D>::kHalo + n.diamond[i].bits);
    }
    return any;
  }

  template <class Exchange>
  int tellRow(Exchange& ask, std::size_t place, const Row& row) {
    int told = 0;
    const Bits truth = ask.row(place, row.brick);
    packs_ = RowPacks<D>::around(&window_.rows[row.window]);
    uint16_t& signs = window_.rows[row.window];
    const uint16_t before = signs;
    for (Bits open = row.open; open != 0; open &= open - 1, ++told) {
      const int x = std::countr_zero(open), at = x + Window<D>::kHalo;
      // Without a branch, which nobody could predict.
      const unsigned turned = (static_cast<unsigned>(signs) >> at & 1) ^ (tell(ask, row, x, (truth >> x & 1) != 0) ? 1u : 0u);
      signs = static_cast<uint16_t>(signs ^ turned << at);
      packs_.flip(turned, at);
    }
    changed_ = changed_ || signs != before;
    return told;
  }

  void put(const Row& row, int x, bool positive) {
    const auto bit = static_cast<uint16_t>(1u << (x + Window<D>::kHalo));
    if (((window_.rows[row.window] & bit) != 0) == positive) return;
    window_.rows[row.window] ^= bit;
    changed_ = true;
  }

  template <class Exchange>
  bool tell(Exchange& ask, const Row& row, int x, bool truth) {
    const auto& n = neighbourhoods_[row.fresh];
    const uint16_t* here = &window_.rows[row.window];
    const int at = x + Window<D>::kHalo;
    auto gather = [&](const Step* steps, int count) {
      unsigned bits = 0;
      for (int i = 0; i < count; ++i) bits = bits << 1 | (static_cast<unsigned>(here[steps[i].rows]) >> (at + steps[i].bits) & 1);
      return bits;
    };
    const auto [diamond, corners, across, nearWeight] = Nearby::unpacked(packs_.diamond(n.slices, at));
    const unsigned first = gather(n.siblings.data(), kSiblings);
    const unsigned siblings = packs_.count(n.siblingMask, at), far = packs_.count(n.farMask, at), outer = packs_.count(n.outerMask, at);
    const int weight = nearWeight + static_cast<int>(far) * Nearby::kFarOne + static_cast<int>(outer) * Nearby::kOuterOne;
    const Table& table = tables_[row.fresh];
    const unsigned counted = table.counted + corners * static_cast<unsigned>(n.acrossCount + 1) + across;
    const std::array<Chance*, kInputs> contexts{&near_[table.near + (diamond << table.siblings | first >> (kSiblings - table.siblings))],
                                                &counts_[counted << kSiblings | first],
                                                &wide_[counted << kWideBits | siblings / 2 << 5 | far / 2]};
    // Positive weights less negative ones, in 1/256 of log-odds.
    const int estimate = (2 * weight - n.weight) * (256 / Nearby::kOne);
    return Mixer<kInputs>::template bit<255, 12>(ask.coder(), truth, contexts, weights_[counted], estimate);
  }

  /// How busy a brick is, as a context for its exceptions.
  static int activity(int told) { return told == 0 ? 0 : told < 6 ? 1 : told < 16 ? 2 : told < 48 ? 3 : 4; }

  /// The members of a row whose sign was deduced and is false.
  template <class Exchange>
  Bits exceptions(Exchange& ask, std::size_t place, const Row& row) const {
    return (ask.row(place, row.brick) ^ window_.rows[row.window] >> Window<D>::kHalo) & row.members & ~Bits{row.open} & ~Bits{row.absent};
  }

  template <class Exchange>
  bool hasExceptions(Exchange& ask, std::size_t place) const {
    Bits any = 0;
    for (int i = 0; i < rowCount_; ++i) any |= exceptions(ask, place, rows_[i]);
    return any != 0;
  }

  template <class Exchange>
  void tellExceptions(Exchange& ask, std::size_t place, int activity) {
    int lately = 0;  // 0 before the first row that has some, 1 right after one, 2 later
    for (int i = 0; i < rowCount_; ++i) {
      const Row& row = rows_[i];
      const Bits deduced = row.members & ~Bits{row.open} & ~Bits{row.absent};
      if (deduced == 0) continue;
      const Bits flips = exceptions(ask, place, row);
      const bool any = rowFlag_[activity][lately].bit(ask.coder(), flips != 0);
      if (any) tellExceptions(ask, row, deduced, flips);
      lately = any ? 1 : std::min(2 * lately, 2);
    }
  }

  /// Those of a row that has some: if all but the last one are none, it is one.
  template <class Exchange>
  void tellExceptions(Exchange& ask, const Row& row, Bits deduced, Bits flips) {
    const Bits signs = static_cast<Bits>(window_.rows[row.window]) >> Window<D>::kHalo;
    for (bool any = false; deduced != 0; deduced &= deduced - 1) {
      const int x = std::countr_zero(deduced);
      const bool sure = !any && (deduced & (deduced - 1)) == 0;
      if (!sure && !vertexFlag_[any ? 1 : 0].bit(ask.coder(), (flips >> x & 1) != 0)) continue;
      put(row, x, (signs >> x & 1) == 0);
      any = true;
    }
  }

  void store(Signs<D>& signs, std::size_t place) {
    changedPlaces_.push_back(place);
    auto& rows = signs.writable(place).rows;
    for (std::size_t r = 0; r < rows.size(); ++r) rows[r] = static_cast<uint8_t>(window_.rows[Window<D>::kOwnRows[r]] >> Window<D>::kHalo);
  }

  const std::array<Neighbourhood<D>, kSets>& neighbourhoods_ = neighbourhoods();
  std::vector<uint8_t> active_;  // bricks of the octave in work, as of activeBricks()
  std::vector<std::size_t> changedPlaces_, absentPlaces_;  // in this bisection of this slab
  std::array<std::size_t, D + 1> told_{};                  // by bisection: the bricks before this place
  Window<D> window_;
  Signs<D>* absent_ = nullptr;  // null: all are in the mesh
  Window<D> absentWindow_;
  RowPacks<D> packs_;
  std::array<Row, kBrickRows> rows_;
  int rowCount_ = 0;
  std::array<uint16_t, kBrickRows> open_;  // which of them have open vertices
  int openCount_ = 0;
  int rowKind_ = -1;  // the class that rows_ are of; -1 where they are of a last brick
  bool changed_ = false;
  /// Where the contexts of a set of fresh axes begin in the tables.
  struct Table {
    uint32_t near = 0, counted = 0;
    int siblings = 0;  // in the contexts that are near
  };
  std::array<Table, kSets> tables_{};
  std::vector<Chance> near_, counts_, wide_;
  std::vector<typename Mixer<kInputs>::Weights> weights_;
  std::array<std::array<Chance, 5>, D + 1> brickFlag_;
  std::array<std::array<Chance, 3>, 5> rowFlag_;
  std::array<Chance, D + 1> groupFlag_, quietFlag_;
  std::array<Chance, 2> vertexFlag_;  // by whether the row had one before
  std::array<Chance, 32> whole_;
};

}  // namespace isostar
