// The state of what only some streams have: preserved topology, a domain, further isovalues.
#pragma once

#include <optional>

#include "coding/adaptive/adaptive_field.h"
#include "coding/isovalues/further_isovalues.h"
#include "util/decodes_all.h"

namespace isostar {

template <int D, bool IsThere = kDecodesAll>
struct RareState {
  /// Replaces the signs in a stream that preserves the topology, up to its finest level.
  std::optional<AdaptiveField<D>> partial;
  Scalars<D> domain;  // of a trimmed stream, as DomainCoder stores them
  FurtherIsovalues<D> further;

  /// Bytes in use, without those of further isovalues.
  [[nodiscard]] uint64_t memory() const {
    return (partial ? partial->memory() : 0) + (domain.tableSize() != 0 ? domain.memory() : 0);
  }
};

/// Of a decoder that refuses such streams.
template <int D>
struct RareState<D, false> {
  [[nodiscard]] uint64_t memory() const { return 0; }
};

}  // namespace isostar
