#include "cli/stream_file.h"

#include <unistd.h>

#include <algorithm>

#include "cli/messages.h"
#include "cli/progress_bar.h"
#include "cli/stopwatch.h"
#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "threads/parallel_tasks.h"

namespace isostar::native {

Limits nativeLimits() {
  const auto memory = static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                      static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
  return {.samples = uint64_t{1} << 36, .vertices = uint64_t{1} << 31, .memory = memory / 4 * 3};
}

StreamInfo inspectStream(std::span<const std::byte> bytes, const std::string& path) {
  StreamInfo info;
  if (const Error error = inspect(bytes, info); error != Error::None)
    throw Failure(path, describe(error));
  return info;
}

namespace {

/// Decodes what has arrived; `length`: of what will come in all.
void decodeArrived(Decoder& decoder, uint64_t length, ProgressBar& bar, const std::string& path) {
  while (decoder.advance())
    bar.show(static_cast<double>(decoder.bytes()) / static_cast<double>(length));
  const Error error = decoder.error();
  const bool prefix = decoder.ready() && error == Error::Truncated;
  if (error != Error::None && !prefix) throw Failure(path, describe(error));
}

}  // namespace

Decoder decodeStream(std::span<const std::byte> bytes, const std::string& path) {
  ProgressBar bar("decoding");
  Decoder decoder(nativeLimits(), parallelTasks());
  decoder.accept(bytes);
  decoder.finish();
  decodeArrived(decoder, bytes.size(), bar, path);
  return decoder;
}

Decoder decodeRegion(const std::string& path, const Region& region, uint64_t& read,
                     double& milliseconds) {
  constexpr uint64_t kPiece = 1 << 22;
  ProgressBar bar("decoding");
  Decoder decoder(nativeLimits(), parallelTasks());
  if (decoder.setRegion(region) != Error::None) throw UsageFault("--region is not a box");
  const PartialFile file(path);
  read = 0;
  for (bool isEnd = false; !isEnd;) {
    const ByteRange next = decoder.wanted();
    const Stopwatch reading;
    const auto bytes =
        file.read(next.begin, static_cast<size_t>(std::min(kPiece, next.end - next.begin)));
    milliseconds += reading.milliseconds();
    read += bytes.size();
    isEnd = bytes.empty();
    if (isEnd)
      decoder.finish();
    else
      decoder.accept(bytes, next.begin);
    decodeArrived(decoder, decoder.info().bytes, bar, path);
  }
  return decoder;
}

bool isDamaged(std::span<const std::byte> bytes, size_t length) {
  Decoder decoder(nativeLimits(), parallelTasks());
  decoder.accept(bytes);
  while (decoder.advance())
    if (decoder.bytes() >= length) return false;
  return decoder.error() == Error::Corrupt;
}

void requireIsovalue(const std::optional<double>& isovalue, const StreamInfo& info,
                     const std::string& path) {
  const auto& held = info.isovalues;
  if (!isovalue) return;
  const auto [least, most] = std::minmax_element(held.begin(), held.end());
  if (*isovalue >= *least && *isovalue <= *most) return;
  std::string list;
  for (const double each : held) list += text("%s%.10g", list.empty() ? "" : ", ", each);
  throw Failure(path, text("does not hold isovalue %.10g; it holds %s%s", *isovalue, list.c_str(),
                           held.size() > 1 ? " and values in between" : ""));
}

Mesh surfaceOf(const Decoder& decoder, const MeshOptions& options, const std::string& path) {
  if (decoder.info().dimension == 2)
    throw Failure(path, "holds an image's contours, which are no surface");
  Mesh mesh;
  if (const Error error = decoder.mesh(options, mesh); error != Error::None)
    throw Failure(path, describe(error));
  return mesh;
}

}  // namespace isostar::native
