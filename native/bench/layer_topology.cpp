#include "bench/layer_topology.h"

#include "bench/isostar_codec.h"
#include "bench/stream_points.h"
#include "measure/mesh_topology.h"

namespace isostar::bench {

using Json = nlohmann::ordered_json;

Json layerTopology(const Subject& subject) {
  const auto stream = encodeIsostarOfOneTopology(subject, EncodeOptions{}.maxError);
  Json layers = Json::array();
  for (const LayerInfo& layer : inspected(stream).layers) {
    const Decoder decoder = decodeIsostar(std::span(stream).first(layer.offset));
    const measure::Topology topology = measure::topologyOf(meshOf(decoder, false));
    layers.push_back({{"kind", layer.kind},
                      {"level", layer.level},
                      {"offset", layer.offset},
                      {"components", topology.components},
                      {"genus", nullptr}});
    if (const auto genus = topology.genus()) layers.back()["genus"] = *genus;
  }
  return {{"isovalue", subject.isovalue},
          {"bytes", stream.size()},
          {"uniform", encodeIsostar(subject, EncodeOptions{}.maxError).size()},
          {"layers", layers}};
}

}  // namespace isostar::bench
