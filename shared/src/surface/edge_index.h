// The number of the mesh's vertex on each crossing edge of a brick, by prefix counts.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace isostar {

inline constexpr unsigned kPlanes = 8;  // along an axis of a brick

/// Where the vertices on a brick's crossing edges along one set of axes are in the list of
/// vertices, by plane.
struct EdgeIndex {
  struct Plane {
    uint64_t crossed;  // bit x + 8 y, as in a VertexSet
    uint32_t first;
  };
  std::array<Plane, kPlanes> planes;

  EdgeIndex() {
    // Leaves the planes uninitialized: filling them with zeros would take longer than counting.
  }

  [[nodiscard]] uint32_t vertex(unsigned plane, unsigned at) const {
    const auto& [crossed, first] = planes[plane];
    return first + static_cast<uint32_t>(std::popcount(crossed & ((uint64_t{1} << at) - 1)));
  }
};

}  // namespace isostar
