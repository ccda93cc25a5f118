// The end of the domain near the surface (§2): distances to its boundary at the tube's
// vertices, as far as trimming needs them.
#pragma once

#include "coding/exchange/exchange.h"
#include "entropy/unary.h"
#include "grid/tube.h"
#include "scalars/scalar_window.h"
#include "util/cold_path.h"

namespace isostar {

/// Distances count steps of Header::domainFineness(), are positive inside, and lie within [-reach,
/// reach). A distance n is stored as 2 n + 1, the middle of [n, n + 1) in half steps, which is
/// never 0. The side of each vertex is coded first. Then the distance is coded of each vertex that
/// has a neighbour on the other side, so that all cells that the boundary crosses have distances.
/// All other vertices keep ±reach.
template <int D>
class DomainCoder {
 public:
  explicit DomainCoder(int32_t reach) : reach_(reach) {}

  /// `diagonals`: include vertices that only Polygonizer::Tetrahedra needs.
  template <DomainExchange Exchange>
  ISOSTAR_COLD void code(Exchange& exchange, const Signs<D>& signs,
                         const std::vector<uint8_t>& active, bool diagonals, Scalars<D>& domain) {
    for (const bool sides : {true, false}) {
      for (std::size_t brickIndex = 0;
           brickIndex < active.size() && exchange.charge(domain.memory()); ++brickIndex) {
        if (active[brickIndex] == 0) continue;
        exchange.visitBrick();
        tube_.enter(signs, brickIndex, Members::AxisEnds);
        if (diagonals) tube_.addDiagonalEnds(signs);
        // Each examines the vertices around.
        exchange.visit(tube_.members().count() * (power(3, D) / 8));
        if (!tube_.empty()) brick(exchange, brickIndex, sides, domain);
      }
    }
  }

 private:
  static constexpr std::size_t kSums = 33, kTrusts = 4, kSteps = 24;
  static constexpr std::size_t kAcross = power(3, D);

  struct Guess {
    int32_t distance;  // steps, on the vertex's own side
    std::size_t trust;
  };
  /// Neighbours of a vertex: offsets in a ScalarWindow, and weights. The first 2 D are those along
  /// the axes; a and a + D are opposite.
  struct Neighbour {
    int offset, weight;
  };
  static constexpr std::array<Neighbour, kAcross> kNeighbours = [] {
    std::array<Neighbour, kAcross> all{};
    std::size_t count = 2 * D;
    std::array<int, D> d{};
    d.fill(-1);
    for (std::size_t n = 0; n < kAcross; ++n) {
      Neighbour neighbour{0, 8};
      std::size_t first = 0;
      for (int a = 0; a < D; ++a) {
        neighbour.offset += d[a] * ScalarWindow<D>::stride(a);
        if (d[a] != 0) {
          neighbour.weight /= 2;
          first = static_cast<std::size_t>(d[a] < 0 ? a : a + D);
        }
      }
      if (neighbour.weight == 8) neighbour.weight = 0;  // the vertex itself
      all[neighbour.weight == 4 ? first : count++] = neighbour;
      for (int a = 0; a < D && ++d[a] == 2; ++a) d[a] = -1;
    }
    return all;
  }();

  [[nodiscard]] int32_t far() const { return 2 * reach_ - 1; }
  [[nodiscard]] bool coded(int32_t value) const {
    return value != Scalars<D>::kUnknown && std::abs(value) < far();
  }

  template <DomainExchange Exchange>
  ISOSTAR_COLD void brick(Exchange& exchange, std::size_t brickIndex, bool sides,
                          Scalars<D>& domain) {
    auto& brick = domain.writable(brickIndex);
    window_.load(domain, tube_.table(), tube_.at());
    tube_.forEach([&](int, std::size_t r, int x) {
      int32_t& value = window_.value[static_cast<std::size_t>(ScalarWindow<D>::index(r, x))];
      value = code(exchange, &value, sides, exchange.domain(brickIndex, r, x));
      brick.value[r * kBrickSide + static_cast<std::size_t>(x)] = value;
    });
  }

  /// Codes the side of a vertex in context of its neighbours' sides, or else its distance if they
  /// are not all on one side. Returns the value to store. `here`: the vertex in a ScalarWindow.
  template <DomainExchange Exchange>
  [[gnu::noinline]] ISOSTAR_COLD int32_t code(Exchange& exchange, const int32_t* here, bool side,
                                              int32_t actual) {
    int sum = 0;
    bool both = false;
    for (const Neighbour& n : kNeighbours) {
      const int32_t value = here[n.offset];
      if (value == Scalars<D>::kUnknown) continue;
      sum += value >= 0 ? n.weight : -n.weight;
      both = both || (value ^ *here) < 0;
    }
    if (!side) return both ? codeDistance(exchange, here, actual) : *here;
    last_ = bit(exchange,
                sides_[last_ ? 1 : 0][static_cast<std::size_t>(std::clamp(sum, -16, 16) + 16)],
                actual >= 0);
    return last_ ? far() : -far();
  }

  /// A distance is nearly linear. The guess is the mean of parallelogram predictions from three
  /// neighbours each, or else the mean of the neighbours.
  [[nodiscard]] ISOSTAR_COLD Guess guess(const int32_t* here) const {
    int32_t sum = 0, count = 0, neighbourSum = 0, neighbourCount = 0;
    for (std::size_t a = 0; a < 2 * D; ++a) {
      const int32_t* const first = here + kNeighbours[a].offset;
      if (!coded(*first)) continue;
      neighbourSum += *first;
      ++neighbourCount;
      for (std::size_t b = 0; b < a; ++b) {
        const int other = kNeighbours[b].offset;
        if (b + D == a || !coded(here[other]) || !coded(first[other])) continue;
        sum += *first + here[other] - first[other];
        ++count;
      }
    }
    const int32_t mean = count > 0            ? sum / count
                         : neighbourCount > 0 ? neighbourSum / neighbourCount
                                              : 0;
    return {
        std::clamp((*here >= 0 ? mean : -mean) >> 1, 0, reach_ - 1),
        static_cast<std::size_t>(count > 0 ? std::min(count, 2) + 1 : std::min(neighbourCount, 1))};
  }

  /// Coded as a number of steps from the guess, in one direction or the other.
  template <DomainExchange Exchange>
  ISOSTAR_COLD int32_t codeDistance(Exchange& exchange, const int32_t* here, int32_t actual) {
    const bool inside = *here >= 0;
    const Guess nearby = guess(here);
    const int32_t guess = nearby.distance;
    const std::size_t trust = nearby.trust;
    const int32_t difference = (inside ? actual : -1 - actual) - guess;
    const bool less = guess > 0 && bit(exchange, less_[trust], difference < 0);
    const int32_t wanted = less ? -difference : difference,
                  most = less ? guess : reach_ - 1 - guess;
    const int steps = codeUnary(wanted, less ? 1 : 0, most, [&](int n, bool larger) {
      return bit(exchange, more_[trust][std::min(static_cast<std::size_t>(n), kSteps - 1)], larger);
    });
    const int32_t coded = less ? guess - steps : guess + steps;
    return inside ? 2 * coded + 1 : -2 * coded - 1;
  }

  template <DomainExchange Exchange>
  ISOSTAR_COLD static bool bit(Exchange& exchange, BitModel& probability, bool actual) {
    return probability.bit(exchange.coder(), actual);
  }

  Tube<D> tube_;
  ScalarWindow<D> window_;
  const int32_t reach_;
  bool last_ = true;
  std::array<std::array<BitModel, kSums>, 2> sides_;
  std::array<BitModel, kTrusts> less_;
  std::array<std::array<BitModel, kSteps>, kTrusts> more_;
};

}  // namespace isostar
