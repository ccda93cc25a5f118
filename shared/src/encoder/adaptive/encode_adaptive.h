// Encodes adaptive streams (§5.1, §5.2): coarse simplices where they keep the bound.
#pragma once

#include "encoder/core/coded_layers.h"
#include "encoder/core/field.h"
#include "isostar/isostar.h"

namespace isostar {

/// Sets `layers` to those of an adaptive stream, and the fields of the header that describe scalars
/// and vertices. Requires options with a bound, and valid samples. Plans repeatedly until the
/// measured surface keeps the bound; false if no plan does.
template <int D>
[[nodiscard]] bool encodeAdaptive(const GridField<D>& field, const EncodeOptions& options,
                                  const Signs<D>& finest, Header& header, CodedLayers& layers);

}  // namespace isostar
