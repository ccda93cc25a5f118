#include "volume/chosen_frame.h"

#include "files/text.h"

namespace isostar::native {

void takeFrame(LoadedVolume& volume, const std::string& path, const Choices& choices) {
  const auto frames = static_cast<size_t>(volume.frames);
  const size_t frame = indexOf(path, "--frame", choices.frame, frames);
  if (frames == 1) return;
  volume.parts.push_back(text("--frame 0 to %zu", frames - 1));
  if (!choices.frame) {
    volume.remarks.push_back(
        text("has %zu frames, which one stream holds; pages show single ones, which --frame 0 to "
             "%zu makes",
             frames, frames - 1));
    return;
  }
  const size_t length = volume.samples.size() / frames;
  const auto first = volume.samples.begin() + static_cast<ptrdiff_t>(frame * length);
  volume.samples = std::vector<float>(first, first + static_cast<ptrdiff_t>(length));
  volume.frames = 1;
  volume.dimension = 3;
}

}  // namespace isostar::native
