// Compares the topology of the surface around a vertex before and after a flip of its sign.
#include "encoder/topology/sign_flips.h"

#include <array>
#include <bit>

#include "surface/cell_table.h"

namespace isostar {
namespace {

/// The vertices of a block: the 2³ cells around a vertex, which is kMiddle.
constexpr unsigned kSide = 3, kVertices = 27, kMiddle = 13;
/// Edges are numbered by their lower vertex and their axes.
constexpr unsigned kAxes = 3, kNodes = kVertices * 8;

/// Connected components of edges (union-find).
class Pieces {
 public:
  Pieces() {
    for (unsigned i = 0; i < kNodes; ++i) root_[i] = static_cast<uint8_t>(i);
  }
  [[nodiscard]] unsigned of(unsigned node) {
    while (root_[node] != node) node = root_[node] = root_[root_[node]];
    return node;
  }
  void join(unsigned a, unsigned b) { root_[of(a)] = static_cast<uint8_t>(of(b)); }

 private:
  std::array<uint8_t, kNodes> root_;
};

/// The signs of a block, and which of its cells lie in the box.
struct Block {
  unsigned signs = 0, cells = 0;
  std::array<bool, kAxes> atEnd{};  // by axis: does the middle lie in a face of the box across it?

  Block(const Signs<3>& all, const Coordinates<3>& v) {
    const auto& last = all.lattice().last;
    unsigned inside = 0;
    for (unsigned i = 0; i < kVertices; ++i) {
      Coordinates<3> w = v;
      bool in = true;
      unsigned rest = i;
      for (int a = 0; a < 3; ++a, rest /= kSide) {
        w[a] += static_cast<int32_t>(rest % kSide) - 1;
        in = in && w[a] >= 0 && w[a] <= last[a];
      }
      if (!in) continue;
      inside |= 1u << i;
      if (all.at(w)) signs |= 1u << i;
    }
    for (unsigned cell = 0; cell < 8; ++cell) {
      bool whole = true;
      for (unsigned corner = 0; corner < 8; ++corner)
        whole = whole && (inside >> vertexOf(cell, corner) & 1) != 0;
      if (whole) cells |= 1u << cell;
    }
    for (int a = 0; a < 3; ++a) atEnd[static_cast<std::size_t>(a)] = v[a] == 0 || v[a] == last[a];
  }
  static unsigned vertexOf(unsigned cell, unsigned corner) {
    unsigned vertex = 0, stride = 1;
    for (unsigned a = 0; a < kAxes; ++a, stride *= kSide)
      vertex += stride * ((cell >> a & 1) + (corner >> a & 1));
    return vertex;
  }
};

/// The surface in a block.
class Patch {
 public:
  explicit Patch(const Block& block) {
    const auto& table = cellTable(Polygonizer::Cubes, 0);
    for (unsigned cells = block.cells; cells != 0; cells &= cells - 1) {
      const auto cell = static_cast<unsigned>(std::countr_zero(cells));
      unsigned signs = 0;
      for (unsigned corner = 0; corner < 8; ++corner)
        signs |= (block.signs >> Block::vertexOf(cell, corner) & 1) << corner;
      add(table[signs], cell, block);
    }
    for (const bool used : used_) twiceEuler_ += used ? 2 : 0;
  }

  /// Are the pieces the same, except for their shape within the block?
  [[nodiscard]] bool isLike(Patch& other) {
    bool same =
        twiceEuler_ == other.twiceEuler_ && alike(surface_, used_, other.surface_, other.used_);
    for (unsigned a = 0; same && a < kAxes; ++a)
      same = alike(curves_[a], onEnd_[a], other.curves_[a], other.onEnd_[a]);
    return same;
  }

 private:
  using Set = std::array<bool, kNodes>;

  void add(const CellCase& shape, unsigned cell, const Block& block) {
    std::array<unsigned, CellCase::kMostEdges> nodes{};
    for (unsigned i = 0; i < shape.edgeCount; ++i) {
      nodes[i] = Block::vertexOf(cell, shape.edges[i].corner) * 8 + shape.edges[i].axes;
      used_[nodes[i]] = true;
      for (unsigned a = 0; a < kAxes; ++a)
        onEnd_[a][nodes[i]] = block.atEnd[a] && liesAcross(nodes[i], a);
    }
    for (unsigned t = 0; t < shape.triangleCount; ++t) {
      --twiceEuler_;
      for (unsigned i = 0; i < 3; ++i) {
        const unsigned from = nodes[shape.triangles[t][i]],
                       to = nodes[shape.triangles[t][(i + 1) % 3]];
        surface_.join(from, to);
        for (unsigned a = 0; a < kAxes; ++a) {
          if (onEnd_[a][from] && onEnd_[a][to]) curves_[a].join(from, to);
        }
      }
    }
  }
  /// Does an edge lie in the plane of the middle across an axis?
  static bool liesAcross(unsigned node, unsigned axis) {
    unsigned vertex = node / 8;
    for (unsigned a = 0; a < axis; ++a) vertex /= kSide;
    return (node >> axis & 1) == 0 && vertex % kSide == 1;
  }
  /// Is an edge not affected by the middle's sign?
  static bool outer(unsigned node) {
    unsigned end = node / 8, stride = 1;
    for (unsigned a = 0; a < kAxes; ++a, stride *= kSide) end += (node >> a & 1) * stride;
    return node / 8 != kMiddle && end != kMiddle;
  }
  /// Names each piece by the first of its outer vertices. False if a piece has none.
  static bool name(Pieces& pieces, const Set& used, std::array<uint8_t, kNodes>& names) {
    constexpr uint8_t kNone = kNodes;
    std::array<uint8_t, kNodes> first;
    first.fill(kNone);
    for (unsigned i = 0; i < kNodes; ++i) {
      if (!used[i] || !outer(i)) continue;
      uint8_t& known = first[pieces.of(i)];
      if (known == kNone) known = static_cast<uint8_t>(i);
      names[i] = known;
    }
    for (unsigned i = 0; i < kNodes; ++i) {
      if (used[i] && first[pieces.of(i)] == kNone) return false;
    }
    return true;
  }
  static bool alike(Pieces& one, const Set& oneUsed, Pieces& other, const Set& otherUsed) {
    std::array<uint8_t, kNodes> names{}, others{};
    return name(one, oneUsed, names) && name(other, otherUsed, others) && names == others;
  }

  Pieces surface_;
  std::array<Pieces, kAxes> curves_;  // on the box's faces
  Set used_{};
  std::array<Set, kAxes> onEnd_{};
  int twiceEuler_ = 0;  // terms that both patches share are left out
};

bool keepsTopology(Block block) {
  Patch before(block);
  block.signs ^= 1u << kMiddle;
  Patch after(block);
  return before.isLike(after);
}

/// Caches results for blocks within the box; most blocks are like earlier ones.
class FlipCache {
 public:
  bool operator()(const Block& block) {
    constexpr unsigned kWhole = 0xFF;
    if (block.cells != kWhole) return keepsTopology(block);
    Entry& entry = entries_[(block.signs * 0x9E3779B1u) >> (32 - kBits)];
    if (entry.signs != block.signs) entry = {block.signs, keepsTopology(block)};
    return entry.keeps;
  }

 private:
  static constexpr unsigned kBits = 14;
  struct Entry {
    uint32_t signs = ~0u;
    bool keeps = false;
  };
  std::vector<Entry> entries_ = std::vector<Entry>(std::size_t{1} << kBits);
};

}  // namespace

bool flipKeepsTopology(const Signs<3>& signs, const Coordinates<3>& v) {
  return keepsTopology(Block(signs, v));
}

std::vector<Coordinates<3>> stuckFlips(Signs<3> from, const Signs<3>& to) {
  std::vector<Coordinates<3>> open;
  for (std::size_t brickIndex = 0; brickIndex < from.table().total(); ++brickIndex) {
    const auto &a = from.brickAt(brickIndex).rows, &b = to.brickAt(brickIndex).rows;
    const auto brick = from.table().brick(brickIndex);
    for (std::size_t r = 0; r < a.size(); ++r) {
      for (unsigned flipped = a[r] ^ b[r]; flipped != 0; flipped &= flipped - 1) {
        const Coordinates<3> v{brick[0] * kBrickSide + std::countr_zero(flipped),
                               brick[1] * kBrickSide + static_cast<int32_t>(r % kBrickSide),
                               brick[2] * kBrickSide + static_cast<int32_t>(r / kBrickSide)};
        const auto& last = from.lattice().last;
        if (v[0] <= last[0] && v[1] <= last[1] && v[2] <= last[2]) open.push_back(v);
      }
    }
  }
  FlipCache keeps;
  for (std::size_t before = open.size() + 1; open.size() < before;) {
    before = open.size();
    std::erase_if(open, [&](const Coordinates<3>& v) {
      if (!keeps(Block(from, v))) return false;
      from.set(v, to.at(v));
      return true;
    });
  }
  return open;
}

}  // namespace isostar
