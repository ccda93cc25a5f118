#include "bench/times.h"

#include <filesystem>

#include "bench/draco_codec.h"
#include "bench/isostar_codec.h"
#include "bench/shortest_times.h"
#include "files/output_file.h"
#include "threads/parallel_tasks.h"

namespace isostar::bench {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = std::vector<std::byte>;

constexpr int kBits = 10;

Json encodeTimes(const Subject& subject, const TimeOptions& options) {
  const auto best = shortestTimes(
      {[&] { marchingCubes(subject.volume, subject.isovalue); },
       [&] { encodeIsostar(subject, EncodeOptions{}.maxError); },
       [&] { encodeIsostar(subject, EncodeOptions{}.maxError, parallelTasks()); },
       [&] { encodeDraco(subject.mesh, 7, kBits); }, [&] { encodeDraco(subject.mesh, 10, kBits); }},
      options.milliseconds);
  return {{"marchingCubes", best[0]},
          {"isostar", best[1]},
          {"isostarInThreads", best[2]},
          {"draco7", best[3]},
          {"draco10", best[4]}};
}

Json decodeTimes(const Bytes& stream, const Bytes& draco7, const Bytes& draco10,
                 const TimeOptions& options) {
  const auto best =
      shortestTimes({[&] { decodeIsostar(stream); }, [&] { meshOf(decodeIsostar(stream), false); },
                     [&] { meshOf(decodeIsostar(stream), true); },
                     [&] { decodeIsostar(stream, parallelTasks()); },
                     [&] { meshOf(decodeIsostar(stream, parallelTasks()), false); },
                     [&] { decodeDraco(draco7); }, [&] { decodeDraco(draco10); }},
                    options.milliseconds);
  return {{"isostar", best[0]},
          {"isostarPolygonized", best[1]},
          {"isostarWithNormals", best[2]},
          {"isostarInThreads", best[3]},
          {"isostarPolygonizedInThreads", best[4]},
          {"draco7", best[5]},
          {"draco10", best[6]}};
}

void write(const Bytes& bytes, const std::filesystem::path& path) {
  native::OutputFile file(path.string());
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace

Json times(const Subject& subject, const TimeOptions& options) {
  if (subject.mesh.indices.empty()) return {};
  const Bytes stream = encodeIsostar(subject, EncodeOptions{}.maxError);
  const Bytes draco7 = encodeDraco(subject.mesh, 7, kBits);
  const Bytes draco10 = encodeDraco(subject.mesh, 10, kBits);
  if (!options.keep.empty()) {
    write(stream, std::filesystem::path(options.keep) / "surface.isostar");
    write(draco7, std::filesystem::path(options.keep) / "surface.drc");
  }
  useThreads(options.threads);
  return {{"threads", options.threads},
          {"encode", encodeTimes(subject, options)},
          {"decode", decodeTimes(stream, draco7, draco10, options)}};
}

}  // namespace isostar::bench
