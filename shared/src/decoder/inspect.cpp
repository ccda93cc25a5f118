// Describes a stream without decoding it.
#include "decoder/stream_description.h"

namespace isostar {

Error inspect(std::span<const std::byte> stream, StreamInfo& out) {
  StreamHeads heads;
  if (const Error error = heads.begin(stream); error != Error::None) return error;
  std::size_t at = heads.start();
  StreamInfo info = describeHeader(heads);
  while (!heads.isEnd(at, info.layers.size()) &&
         (at < stream.size() || heads.header().chunkSide != 0)) {
    LayerHead head;
    std::size_t used = 0;
    const Error error = heads.next(stream, at, info.layers.size(), head, used);
    if (error == Error::Truncated) break;
    if (error != Error::None) return error;
    at += used;
    addLayer(info, heads.header(), head, used, at);
    if (heads.header().chunkSide == 0 && head.bytes > stream.size() - at) break;
    at += static_cast<std::size_t>(head.bytes);
  }
  out = std::move(info);
  return Error::None;
}

}  // namespace isostar
