#include "volume/child_reader.h"

#include "files/child_process.h"

namespace isostar::native {

LoadedVolume readInChild(const std::string& path, const std::function<LoadedVolume()>& read) {
  Handover handover(path);
  runInChild(handover, [&read](Handover& to) {
    const LoadedVolume volume = read();
    to.put(volume.remarks);
    to.put(volume.dimension);
    to.put(volume.size);
    to.put(volume.frames);
    to.put(volume.placement);
    to.put(volume.samples);
  });
  LoadedVolume volume;
  handover.take(volume.remarks);
  handover.take(volume.dimension);
  handover.take(volume.size);
  handover.take(volume.frames);
  handover.take(volume.placement);
  handover.take(volume.samples);
  return volume;
}

}  // namespace isostar::native
