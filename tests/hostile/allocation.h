// How much memory the code under test holds.
#pragma once

#include <cstddef>

namespace isostar {

/// Bytes of operator new since its construction. Only one may exist at a time.
class Allocation {
 public:
  Allocation();
  [[nodiscard]] std::size_t peak() const;
};

}  // namespace isostar
