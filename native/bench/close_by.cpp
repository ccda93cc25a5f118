#include "bench/close_by.h"

#include "bench/isostar_codec.h"

namespace isostar::bench {

nlohmann::ordered_json further(const Subject& subject, double other) {
  const double bound = EncodeOptions{}.maxError;
  return {{"isovalue", subject.isovalue},
          {"other", other},
          {"bytes", encodeIsostar(subject, bound).size()},
          {"otherBytes", encodeIsostar({subject.volume, other, subject.effort, {}}, bound).size()},
          {"together", encodeIsostarWith(subject, other, bound).size()}};
}

}  // namespace isostar::bench
