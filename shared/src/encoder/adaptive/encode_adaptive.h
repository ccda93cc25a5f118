// Adaptive streams (§5.1, §5.2): coarse simplices where they keep the bound.
#pragma once

#include "encoder/core/field.h"
#include "isostar/isostar.h"

namespace isostar {

/// Sets `layers` to those of an adaptive stream and fills in what the header says of scalars and
/// vertices. The options have a bound; the field is sensible. Plans until the surface is measured
/// to keep the bound; false where no plan does.
template <int D>
[[nodiscard]] bool encodeAdaptive(const GridField<D>& field, const EncodeOptions& options,
                                  const Signs<D>& finest, Header& header,
                                  std::vector<std::byte>& layers);

}  // namespace isostar
