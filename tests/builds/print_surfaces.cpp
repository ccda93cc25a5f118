// Encodes the golden sources, and volumes of a list, to FOLDER and prints what each stream decodes
// to: print_surfaces FOLDER [LIST]. A line of LIST: name, three sizes, isovalue, and the name of a
// file of 32-bit floats beside the list.
//
// Prints a line for each stream, `stream NAME BYTES`, and for each of its surfaces, after each
// layer: `mesh NAME LENGTH POLYGONIZER ISOVALUE FRAME VERTICES CHECKSUM`, where LENGTH is that of
// the decoded prefix, ISOVALUE an index, and CHECKSUM covers every bit of positions, normals and
// indices. print-surfaces.mjs prints the same with the page's decoder.
#include <bit>
#include <cstring>
#include <filesystem>
#include <iostream>

#include "golden/golden_sources.h"
#include "golden/golden_table.h"

using namespace isostar;

namespace {

template <class Number>
void add(Fnv& fnv, const std::vector<Number>& numbers) {
  for (const Number n : numbers) fnv.add(std::bit_cast<uint32_t>(n));
}

struct Shown {
  size_t vertices = 0;
  uint32_t checksum = 0;
};

Shown shown(const Decoder& decoder, const MeshOptions& options) {
  Fnv fnv;
  if (decoder.info().dimension == 2) {
    Contours contours;
    if (decoder.contours(options, contours) != Error::None) return {};
    add(fnv, contours.points);
    add(fnv, contours.starts);
    return {contours.points.size() / 2, fnv.sum()};
  }
  Mesh mesh;
  if (decoder.mesh(options, mesh) != Error::None) return {};
  add(fnv, mesh.positions);
  add(fnv, mesh.normals);
  add(fnv, mesh.indices);
  return {mesh.positions.size() / 3, fnv.sum()};
}

void printSurfaces(const std::string& name, const Decoder& decoder) {
  const StreamInfo& info = decoder.info();
  for (const auto polygonizer : {Polygonizer::Cubes, Polygonizer::Tetrahedra}) {
    for (size_t i = 0; i < info.isovalues.size(); ++i) {
      for (int32_t frame = 0; frame < info.frames; ++frame) {
        const auto [vertices, checksum] =
            shown(decoder, {polygonizer, Frame::World, true, double(frame), info.isovalues[i]});
        std::cout << "mesh " << name << ' ' << decoder.bytes() << ' '
                  << (polygonizer == Polygonizer::Cubes ? "cubes" : "tetrahedra") << ' ' << i << ' '
                  << frame << ' ' << vertices << ' ' << std::hex << checksum << std::dec << '\n';
      }
    }
  }
}

bool printStream(const GoldenSource& source, const std::string& folder) {
  std::vector<std::byte> stream;
  if (source.encode(stream) != Error::None) return false;
  std::ofstream(folder + "/" + source.name + ".isostar", std::ios::binary)
      .write(reinterpret_cast<const char*>(stream.data()),
             static_cast<std::streamsize>(stream.size()));
  std::cout << "stream " << source.name << ' ' << stream.size() << '\n';
  Decoder decoder;
  decoder.accept(stream);
  decoder.finish();
  while (decoder.advance()) printSurfaces(source.name, decoder);
  return decoder.isFinal();
}

std::vector<GoldenSource> volumesOf(const std::filesystem::path& list) {
  std::vector<GoldenSource> sources;
  std::ifstream in(list);
  SampledField field;
  EncodeOptions options;
  std::string file;
  while (in >> field.name >> field.size[0] >> field.size[1] >> field.size[2] >> options.isovalue >>
         file) {
    const std::vector<std::byte> bytes = goldenBytes(list.parent_path() / file);
    field.samples.resize(bytes.size() / sizeof(float));
    std::memcpy(field.samples.data(), bytes.data(), field.samples.size() * sizeof(float));
    sources.push_back(golden::of(field, options));
  }
  return sources;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) return 2;
  std::vector<GoldenSource> sources = goldenSources();
  if (argc == 3) {
    const auto volumes = volumesOf(argv[2]);
    sources.insert(sources.end(), volumes.begin(), volumes.end());
  }
  for (const GoldenSource& source : sources) {
    if (printStream(source, argv[1])) continue;
    std::cerr << source.name << " cannot be encoded and decoded\n";
    return 1;
  }
  return 0;
}
