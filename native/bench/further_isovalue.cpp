#include "bench/further_isovalue.h"

#include "bench/isostar_codec.h"

namespace isostar::bench {

nlohmann::ordered_json furtherIsovalue(const Subject& subject, double other) {
  const double bound = EncodeOptions{}.maxError;
  const Subject alone{
      .volume = subject.volume, .isovalue = other, .effort = subject.effort, .mesh = {}};
  return {{"isovalue", subject.isovalue},
          {"other", other},
          {"bytes", encodeIsostar(subject, bound).size()},
          {"otherBytes", encodeIsostar(alone, bound).size()},
          {"together", encodeIsostarWith(subject, other, bound).size()}};
}

}  // namespace isostar::bench
