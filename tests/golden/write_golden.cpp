// Rewrites the golden streams and the table of their surfaces: write_golden FOLDER. README.md says
// when that is allowed.
#include <iostream>

#include "golden_sources.h"
#include "golden_table.h"

using namespace isostar;

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string folder = std::string(argv[1]) + "/";
  std::ofstream table(folder + kGoldenTable);
  table << "# stream dimension bytes isovalue time vertices triangles positions indices (README.md "
           "says what they mean)\n";
  for (const GoldenSource& source : goldenSources()) {
    std::vector<std::byte> stream;
    if (source.encode(stream) != Error::None) return 1;
    std::ofstream(folder + source.name + ".isostar", std::ios::binary)
        .write(reinterpret_cast<const char*>(stream.data()),
               static_cast<std::streamsize>(stream.size()));
    const auto surfaces = surfacesOf(source.name, stream);
    if (surfaces.empty()) return 1;
    for (const GoldenSurface& surface : surfaces) table << surface << '\n';
    std::cout << source.name << ": " << stream.size() << " bytes\n";
  }
  return table.flush() ? 0 : 1;
}
