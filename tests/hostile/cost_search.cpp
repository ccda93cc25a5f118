// Searches for the streams that cost a decoder most: `isostar_cost_search [SECONDS [SHIFT
// [FOLDER]]]` starts with the known kinds, mutates recipes for SECONDS under the default limits
// divided by 2^SHIFT, and prints the worst of each measure. FOLDER receives their streams. With 0
// SECONDS it measures the known kinds.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>

#include "cost.h"
#include "costly_kinds.h"

using namespace isostar;

namespace {

struct Found {
  CostlyStream recipe;
  Cost cost;
};

using Measure = double (*)(const Cost&);
const std::vector<std::pair<const char*, Measure>> kMeasures{
    {"peak", [](const Cost& c) { return double(c.peak); }},
    {"peak-per-byte", [](const Cost& c) { return double(c.peak) / double(c.bytes); }},
    {"time", [](const Cost& c) { return c.decoding; }},
    {"time-per-byte", [](const Cost& c) { return c.decoding / double(c.bytes); }},
    {"surface-time", [](const Cost& c) { return c.showing; }},
};

class Mutation {
 public:
  explicit Mutation(uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t end) { return random_() % end; }

  void change(CostlyStream& s) {
    for (std::size_t i = 1 + below(3); i > 0; --i) step(s);
  }

 private:
  void step(CostlyStream& s) {
    switch (below(9)) {
      case 0: {
        int32_t& n = s.header.size[below(static_cast<std::size_t>(s.header.dimension))];
        n = std::clamp(n + n / 8 * (static_cast<int32_t>(below(9)) - 4), 2, 1 << 20);
        return;
      }
      case 1:
        s.noisy = below(2) * below(1u << below(16));
        return;
      case 2:
        s.noisyGeometry = below(1u << below(10));
        return;
      case 3:
        s.surprise = below(2) == 0 ? 0 : 1.0 / static_cast<double>(2u << below(12));
        return;
      case 4:
        s.surpriseGeometry = below(2) == 0 ? 0 : 1.0 / static_cast<double>(2u << below(12));
        return;
      case 5:
        s.repeats = 1 << below(9);
        return;
      case 6:
        s.seed = random_();
        return;
      case 7:
        if (s.header.dimension == 4) return;
        s.header.fitted = below(2) != 0;
        s.header.polygonizer = kPolygonizers[below(2)];
        return;
      default:
        pass(below(2) == 0 || s.furtherPasses.empty() ? s.passes : s.furtherPasses);
    }
  }
  void pass(std::vector<CostlyPass>& passes) {
    if (passes.size() > 1 && below(3) == 0) {
      passes.erase(passes.begin() + static_cast<std::ptrdiff_t>(below(passes.size())));
      return;
    }
    CostlyPass added;
    constexpr std::array kKinds{LayerKind::Exponents, LayerKind::Magnitudes, LayerKind::Magnitudes};
    added.kind = kKinds[below(3)];
    added.members = static_cast<Members>(below(2));
    added.range = static_cast<int>(below(33));
    added.most = static_cast<int>(below(33));
    added.allowed = static_cast<uint32_t>(below(1u << below(20)));
    added.diagonals = below(2) != 0;
    added.selective = below(4) == 0;
    passes.insert(passes.begin() + static_cast<std::ptrdiff_t>(below(passes.size() + 1)), added);
  }

  std::mt19937_64 random_;
};

void print(const char* why, const Found& found, long resident) {
  const Cost& c = found.cost;
  std::printf("%-14s %-21s %8zu %8.1f %8.1f %8.2f %9.2f %8.2f %8.1f %4zu %s\n", why,
              found.recipe.name.c_str(), c.bytes, double(c.peak) / 1e6,
              double(c.peak) / 1e3 / double(c.bytes), c.decoding,
              c.decoding * 1e3 / double(c.bytes), c.showing, double(resident) / 1e3, c.layers,
              name(c.error));
  std::fflush(stdout);
}

/// The most memory that a process of its own holds for a stream, in kB.
long residentOf(const Bytes& bytes, const Limits& limits) {
  const pid_t child = fork();
  if (child == 0) {
    (void)costOf(bytes, limits);
    _exit(0);
  }
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  return usage.ru_maxrss;
}

void report(const char* why, Found found, const Limits& limits, const char* folder) {
  const Bytes bytes = assembled(found.recipe, limits);
  print(why, found, residentOf(bytes, limits));
  if (folder == nullptr) return;
  std::string file = std::string(folder) + "/" + why + "-" + found.recipe.name + ".isostar";
  std::replace(file.begin() + static_cast<std::ptrdiff_t>(std::strlen(folder)), file.end(), ' ',
               '-');
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::stod(argv[1]) : 60;
  const int shift = argc > 2 ? std::stoi(argv[2]) : 6;
  const char* folder = argc > 3 ? argv[3] : nullptr;
  Limits limits;
  limits.memory >>= shift;
  limits.decisions >>= shift;
  std::printf("%-14s %-21s %8s %8s %8s %8s %9s %8s %8s %4s %s\n", "worst", "kind", "bytes", "MB",
              "kB/byte", "decode s", "ms/byte", "mesh s", "RSS MB", "lay.", "ends");
  std::vector<Found> known;
  for (const CostlyStream& recipe : costlyKinds(320 >> (shift + 1) / 3)) {
    known.push_back({recipe, costOf(assembled(recipe, limits), limits)});
    report("known", known.back(), limits, folder);
  }
  if (seconds <= 0) return 0;
  std::vector<Found> best;
  for (const auto& [why, measure] : kMeasures)
    best.push_back(*std::max_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
      return measure(a.cost) < measure(b.cost);
    }));
  Mutation mutation(1);
  std::size_t tried = 0;
  for (const double end = processorSeconds() + seconds; processorSeconds() < end; ++tried) {
    Found next = mutation.below(4) == 0 ? known[mutation.below(known.size())]
                                        : best[mutation.below(best.size())];
    mutation.change(next.recipe);
    next.cost = costOf(assembled(next.recipe, limits), limits);
    for (std::size_t i = 0; i < best.size(); ++i)
      if (kMeasures[i].second(next.cost) > kMeasures[i].second(best[i].cost)) best[i] = next;
  }
  std::printf("%zu streams tried\n", tried);
  for (std::size_t i = 0; i < best.size(); ++i) report(kMeasures[i].first, best[i], limits, folder);
  return 0;
}
