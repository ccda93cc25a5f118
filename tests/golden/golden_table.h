// The expected surfaces of golden streams: one line for each surface, as in surfaces.txt.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "isostar/isostar.h"

namespace isostar {

inline constexpr const char* kGoldenTable = "surfaces.txt";

/// A surface of a complete stream by the stream's own polygonizer, with vertices in grid steps. For
/// an image: its contours.
struct GoldenSurface {
  std::string stream;
  int dimension = 3;
  uint64_t bytes = 0;  // of the stream
  double isovalue = 0, time = 0;
  uint64_t vertices = 0, triangles = 0;  // of an image: points, polylines
  uint32_t positions = 0, indices = 0;   // checksums

  friend bool operator==(const GoldenSurface&, const GoldenSurface&) = default;
  friend std::ostream& operator<<(std::ostream& out, const GoldenSurface& s) {
    return out << s.stream << ' ' << s.dimension << ' ' << s.bytes << ' ' << s.isovalue << ' '
               << s.time << ' ' << s.vertices << ' ' << s.triangles << ' ' << std::hex
               << s.positions << ' ' << s.indices << std::dec;
  }
  friend std::istream& operator>>(std::istream& in, GoldenSurface& s) {
    return in >> s.stream >> s.dimension >> s.bytes >> s.isovalue >> s.time >> s.vertices >>
           s.triangles >> std::hex >> s.positions >> s.indices >> std::dec;
  }
};

/// 32-bit FNV-1a over whole numbers, each as four bytes, the lowest first.
class Fnv {
 public:
  void add(uint32_t number) {
    for (int shift = 0; shift < 32; shift += 8)
      sum_ = (sum_ ^ (number >> shift & 0xFF)) * 16777619u;
  }
  [[nodiscard]] uint32_t sum() const { return sum_; }

 private:
  uint32_t sum_ = 2166136261u;
};

/// The checksum of coordinates, rounded to 1/1024 of a grid step.
inline uint32_t checksumOf(const std::vector<float>& coordinates) {
  Fnv fnv;
  for (const float c : coordinates)
    fnv.add(static_cast<uint32_t>(static_cast<int32_t>(std::floor(double{c} * 1024 + 0.5))));
  return fnv.sum();
}
inline uint32_t checksumOf(const std::vector<uint32_t>& indices) {
  Fnv fnv;
  for (const uint32_t i : indices) fnv.add(i);
  return fnv.sum();
}

/// False where a surface cannot be made.
inline bool measure(const Decoder& decoder, GoldenSurface& surface) {
  const MeshOptions options{decoder.info().polygonizer, Frame::Grid, false, surface.time,
                            surface.isovalue};
  if (surface.dimension == 2) {
    Contours contours;
    if (decoder.contours(options, contours) != Error::None) return false;
    surface.vertices = contours.points.size() / 2;
    surface.triangles = contours.starts.empty() ? 0 : contours.starts.size() - 1;
    surface.positions = checksumOf(contours.points);
    surface.indices = checksumOf(contours.starts);
    return true;
  }
  Mesh mesh;
  if (decoder.mesh(options, mesh) != Error::None) return false;
  surface.vertices = mesh.positions.size() / 3;
  surface.triangles = mesh.indices.size() / 3;
  surface.positions = checksumOf(mesh.positions);
  surface.indices = checksumOf(mesh.indices);
  return true;
}

/// All surfaces of a stream: of each isovalue, and of the first and the last frame. Empty if the
/// stream does not decode completely.
inline std::vector<GoldenSurface> surfacesOf(const std::string& name,
                                             const std::vector<std::byte>& stream) {
  Decoder decoder;
  decoder.accept(stream);
  decoder.finish();
  while (decoder.advance()) {
  }
  std::vector<GoldenSurface> surfaces;
  if (!decoder.isFinal()) return surfaces;
  const StreamInfo& info = decoder.info();
  for (const double isovalue : info.isovalues) {
    for (const int32_t frame : {0, info.frames - 1}) {
      GoldenSurface surface{name, info.dimension, info.bytes, isovalue, double(frame)};
      if (!measure(decoder, surface)) return {};
      surfaces.push_back(surface);
      if (info.frames == 1) break;
    }
  }
  return surfaces;
}

inline std::vector<std::byte> goldenBytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// All golden streams in a folder, by name.
inline std::vector<std::vector<std::byte>> goldenStreams(const std::string& folder) {
  std::set<std::string> paths;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() == ".isostar") paths.insert(file.path().string());
  }
  std::vector<std::vector<std::byte>> streams;
  for (const std::string& path : paths) streams.push_back(goldenBytes(path));
  return streams;
}

/// The lines of a table except comments.
inline std::vector<GoldenSurface> goldenTable(const std::string& path) {
  std::vector<GoldenSurface> table;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    words >> table.emplace_back();
  }
  return table;
}

}  // namespace isostar
