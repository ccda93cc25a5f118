#include "bench/adaptive_rate.h"

#include "bench/draco_points.h"
#include "bench/isostar_codec.h"
#include "bench/stream_points.h"

namespace isostar::bench {

using Json = nlohmann::ordered_json;

Json adaptiveRate(const Subject& subject, double maxError, const SizeOptions& options) {
  Json json = {{"isovalue", subject.isovalue}, {"vertices", subject.mesh.positions.size() / 3}};
  if (subject.mesh.indices.empty()) return json;
  const DistanceMeter meter(subject.mesh, options.points);
  const auto stream = encodeIsostarAdaptive(subject, maxError);
  json["adaptive"] = point(stream.size(), meter.thoroughDistance(decodedMesh(stream, subject)));
  json["adaptive"]["coarse"] = inspected(stream).adaptive;
  json["uniform"] = encodeIsostar(subject, maxError).size();
  json["prefixes"] =
      prefixes(encodeIsostar(subject, EncodeOptions{}.maxError), subject, meter, options.prefixes);
  json["bounds"] = otherBounds(subject, meter);
  json["draco"] = dracoPoints(subject.mesh, meter);
  json["simplified"] = simplifiedPoints(subject.mesh, meter);
  return json;
}

}  // namespace isostar::bench
