// All cells' triangles of a polygonizer.
#pragma once

#include <vector>

#include "surface/cell_cut.h"
#include "util/cold_path.h"
#include "util/decodes_all.h"

namespace isostar {

class CellCuts {
 public:
  ISOSTAR_COLD CellCuts(Polygonizer polygonizer, bool mirrored)
      : parities_(kDecodesAll && polygonizer == Polygonizer::Tetrahedra ? 8 : 1) {
    cuts_.reserve(parities_ * 256);
    for (unsigned parity = 0; parity < parities_; ++parity) {
      for (const CellCase& shape : cellTable(polygonizer, parity))
        cuts_.emplace_back(shape, mirrored);
    }
  }

  /// How many cell tables there are, one per parity.
  [[nodiscard]] std::size_t parities() const { return parities_; }
  [[nodiscard]] const CellCut& of(std::size_t parity, unsigned signs) const {
    return cuts_[parity * 256 + signs];
  }

 private:
  std::size_t parities_;
  std::vector<CellCut> cuts_;  // by parity, if there are several tables; then by signs
};

}  // namespace isostar
