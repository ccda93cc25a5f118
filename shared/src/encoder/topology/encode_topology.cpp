// Finds the kept cells of a stream that preserves the topology, by trial.
#include "encoder/topology/encode_topology.h"

#include "coding/adaptive/adaptive_field.h"
#include "encoder/topology/sign_flips.h"
#include "encoder/topology/topology_plan.h"

namespace isostar {
namespace {

struct NoScalars {};

/// Splits cells around the vertices that cannot be flipped in what a decoder shows at each step of
/// the plan's stream. Returns how many such vertices there were.
std::size_t improve(TopologyPlan<3>& plan, const Header& header,
                    const std::vector<Signs<3>>& actual, double reach) {
  std::vector<std::byte> discarded;
  RangeEncoder coder(discarded);
  const NoScalars none;
  EncoderExchange<3, RangeEncoder, NoScalars> exchange(coder, actual.front(), none);
  exchange.setLevels(actual, plan.centres());
  AdaptiveField<3> field(header.base<3>());
  field.mesh.codeAll(exchange, header.finestLevel());
  std::size_t stuck = 0;
  std::vector<std::vector<Coordinates<3>>> byLevel;
  for (int level = 0; level < header.finestLevel(); ++level) {
    if (level > 0) {
      exchange.enterLevel(level);
      field.mesh.fill(exchange, level);
    }
    byLevel.push_back(stuckFlips(actual.back(), field.shown(header.finestLevel())->signs));
    stuck += byLevel.back().size();
  }
  for (std::size_t level = 0; level < byLevel.size(); ++level) {
    for (const auto& v : byLevel[level]) plan.forbid(v, static_cast<int>(level) + 1, reach);
  }
  return stuck;
}

}  // namespace

std::vector<Signs<3>> wholeCells(const Header& header, const std::vector<Signs<3>>& actual) {
  TopologyPlan<3> plan(actual);
  // The reach grows until in the end no cell is kept, because the cause of a stuck vertex may be
  // further away.
  for (double reach = 0; improve(plan, header, actual, reach) != 0; reach = reach * 1.5 + 0.25)
    plan.update();
  return plan.centres();
}

}  // namespace isostar
