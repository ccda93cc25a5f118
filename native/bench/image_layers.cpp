#include "bench/image_layers.h"

#include "bench/isostar_codec.h"
#include "bench/stream_points.h"
#include "files/failure.h"
#include "volume/volume_reader.h"

namespace isostar::bench {

using Json = nlohmann::ordered_json;

Json imageLayers(const std::string& path, double isovalue) {
  const native::LoadedVolume image = native::readVolume({.path = path});
  if (image.dimension != 2) throw native::Failure(path, "is not an image");
  EncodeOptions options;
  options.isovalue = isovalue;
  options.lossless = true;
  std::vector<std::byte> stream;
  require(encode(image.image(), options, stream), "encode");
  Contours source, decoded;
  require(polygonize(image.image(), isovalue, {}, source), "polygonize");
  require(decodeIsostar(stream).contours({}, decoded), "polygonize");
  Json layers = Json::array();
  for (const LayerInfo& layer : inspected(stream).layers) layers.push_back(layerJson(layer));
  return {{"points", source.points.size() / 2},
          {"bytes", stream.size()},
          {"lossless", source.points == decoded.points && source.starts == decoded.starts},
          {"layers", layers}};
}

}  // namespace isostar::bench
