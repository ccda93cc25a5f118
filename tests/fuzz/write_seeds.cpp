// Writes small sound streams and files as corpora for the fuzzers, a folder for each kind:
// write_seeds FOLDER.
#include <filesystem>
#include <iostream>

#include "reader_seeds.h"
#include "seed_folder.h"
#include "stream_seeds.h"

namespace {

using namespace isostar;

void writeStreams(SeedFolder seeds, const StreamSeeds& streams) {
  for (const auto& stream : streams.streams())
    seeds.write({reinterpret_cast<const char*>(stream.data()), stream.size()});
}

/// Inputs of round_trip_fuzz: options, a size of at most 4 × 4 × 4, a kind of samples, samples.
void writeRoundTrips(SeedFolder seeds) {
  constexpr std::size_t kOptions = 7, kSamples = 64 * sizeof(float);
  constexpr uint64_t kMultiplier = 6364136223846793005, kIncrement = 1442695040888963407;
  uint64_t state = 1;
  const auto byte = [&] {
    state = state * kMultiplier + kIncrement;
    return static_cast<char>(state >> 56);
  };
  for (int i = 0; i < 32; ++i) {
    std::string input;
    for (std::size_t option = 0; option < kOptions; ++option) input += byte();
    input[kOptions - 1] = 0;  // no further isovalues: their bytes would follow
    input += byte();          // best effort
    for (int axis = 0; axis < 3; ++axis) input += static_cast<char>(1 + (byte() & 1) + (i & 1));
    input += static_cast<char>(i / 2 % 4);
    while (input.size() < kSamples) input += byte();
    seeds.write(input);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  writeReaderSeeds(folder);
  writeRoundTrips(SeedFolder(folder / "round_trip"));
  const StreamSeeds streams = streamSeeds();
  writeStreams(SeedFolder(folder / "streams"), streams);
  if (streams.allAsIntended()) return 0;
  std::cerr << "write_seeds: a stream could not be written as intended\n";
  return 1;
}
