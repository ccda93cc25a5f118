// Many streams of every kind with damage of every kind: with the checksums that they had they are
// refused, and with right ones they are harmless. ISOSTAR_DAMAGED_STREAMS is how many,
// ISOSTAR_DAMAGE_SEED selects others.
#include <cstdlib>
#include <iomanip>
#include <iostream>

#include "damage.h"
#include "fuzz/stream_seeds.h"
#include "golden/golden_table.h"
#include "harmless.h"

namespace isostar {
namespace {

uint64_t numberFrom(const char* variable, uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

/// The golden streams and streams of small sources.
std::vector<Bytes> soundStreams() {
  const StreamSeeds seeds = streamSeeds();
  EXPECT_TRUE(seeds.allAsIntended());
  std::vector<Bytes> streams = goldenStreams(ISOSTAR_GOLDEN);
  streams.insert(streams.end(), seeds.streams().begin(), seeds.streams().end());
  return streams;
}

/// A checksum of 16 bits passes one in 65,536 of errors that are longer than itself. None may pass
/// before it is likely.
constexpr uint64_t kTriedPerAccepted = 1u << 15;

struct Counts {
  uint64_t tried = 0, unchanged = 0, refused = 0, accepted = 0;  // with the checksums that they had
  uint64_t mendedWhole = 0, mendedRefused = 0;                   // with right checksums

  Counts& operator+=(const Counts& other) {
    tried += other.tried;
    unchanged += other.unchanged;
    refused += other.refused;
    accepted += other.accepted;
    mendedWhole += other.mendedWhole;
    mendedRefused += other.mendedRefused;
    return *this;
  }
};

bool isWhole(const Decoder& decoder) {
  return decoder.isFinal() && decoder.error() == Error::None;
}

/// What follows after a stream's end is not read.
bool beginsWith(const Bytes& bytes, const Bytes& stream) {
  return bytes.size() >= stream.size() && std::equal(stream.begin(), stream.end(), bytes.begin());
}

/// `number` selects the surfaces to make.
Counts countsOf(const Damaged& damaged, const Bytes& sound, std::size_t number) {
  Counts counts{.tried = 1};
  const auto whole = [&](const Bytes& b) { return isWhole(harmlesslyDecodedToTheEnd(b, number)); };
  if (beginsWith(damaged.kept, sound)) {
    counts.unchanged = 1;
    return counts;
  }
  ++(whole(damaged.kept) ? counts.accepted : counts.refused);
  ++(whole(damaged.mended) ? counts.mendedWhole : counts.mendedRefused);
  return counts;
}

void print(const char* kind, const Counts& c) {
  std::cout << std::left << std::setw(18) << kind << std::right;
  for (const uint64_t n :
       {c.tried, c.unchanged, c.refused, c.accepted, c.mendedWhole, c.mendedRefused})
    std::cout << std::setw(10) << n;
  std::cout << '\n';
}

void print(const std::array<Counts, kDamages.size()>& counts) {
  std::cout << "                                 checksums kept       made right\n"
               "damage                 tried unchanged   refused  accepted     whole   refused\n";
  Counts sum;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    print(kDamages[kind], counts[kind]);
    sum += counts[kind];
  }
  print("all", sum);
}

TEST(DamagedStreams, areRefusedOrHarmless) {
  const uint64_t count = numberFrom("ISOSTAR_DAMAGED_STREAMS", 1000),
                 seed = numberFrom("ISOSTAR_DAMAGE_SEED", 1);
  std::vector<DamagedStreams> streams;
  for (Bytes& sound : soundStreams()) streams.emplace_back(std::move(sound), seed + streams.size());
  std::array<Counts, kDamages.size()> counts;
  std::mt19937_64 random(seed);
  for (uint64_t i = 0; i < count && !HasFailure(); ++i) {
    DamagedStreams& stream = streams[i % streams.size()];
    const std::size_t kind = i / streams.size() % kDamages.size();
    SCOPED_TRACE(std::string(kDamages[kind]) + ", number " + std::to_string(i));
    counts[kind] += countsOf(stream.next(static_cast<Damage>(kind)), stream.sound(), random());
    EXPECT_LE(counts[kind].accepted, counts[kind].tried / kTriedPerAccepted);
  }
  print(counts);
}

}  // namespace
}  // namespace isostar
