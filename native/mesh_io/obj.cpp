#include <array>
#include <charconv>

#include "files/failure.h"
#include "files/text.h"
#include "mesh_io/mesh_formats.h"
#include "mesh_io/word_reader.h"

namespace isostar::native {
namespace {

/// One line of text of at most 128 characters.
class Line {
 public:
  void append(const char* letters) {
    while (*letters) *at_++ = *letters++;
  }
  void append(auto number) { at_ = std::to_chars(at_, text_.data() + text_.size(), number).ptr; }
  void writeTo(OutputFile& file) {
    *at_++ = '\n';
    file.write(text_.data(), static_cast<size_t>(at_ - text_.data()));
    at_ = text_.data();
  }

 private:
  std::array<char, 128> text_;
  char* at_ = text_.data();
};

void writeVectors(const char* keyword, const std::vector<float>& numbers, OutputFile& file) {
  Line line;
  for (size_t i = 0; i + 2 < numbers.size(); i += 3) {
    line.append(keyword);
    for (size_t axis = 0; axis < 3; ++axis) {
      line.append(" ");
      line.append(numbers[i + axis]);
    }
    line.writeTo(file);
  }
}

void readVertex(std::string_view line, Mesh& mesh, const std::string& path) {
  for (int axis = 0; axis < 3; ++axis) {
    float coordinate;
    if (!parseNumber(nextWord(line), coordinate))
      throw Failure(path,
                    text("vertex %zu does not have three coordinates", mesh.positions.size() / 3));
    mesh.positions.push_back(coordinate);
  }
}

/// "7/2/7" is vertex 7; "-1" is the last vertex read so far.
uint32_t cornerOf(std::string_view word, size_t vertices, const std::string& path) {
  int64_t index = 0;
  const bool number = parseNumber(word.substr(0, word.find('/')), index);
  const int64_t found = index < 0 ? static_cast<int64_t>(vertices) + index : index - 1;
  if (!number || found < 0 || found > UINT32_MAX)
    throw Failure(path, text("a face uses vertex %s", std::string(word).c_str()));
  return static_cast<uint32_t>(found);
}

void readFace(std::string_view line, Mesh& mesh, const std::string& path) {
  const size_t vertices = mesh.positions.size() / 3;
  uint32_t first = 0, previous = 0;
  int corners = 0;
  for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line), ++corners) {
    const uint32_t corner = cornerOf(word, vertices, path);
    if (corners == 0) first = corner;
    if (corners >= 2) mesh.indices.insert(mesh.indices.end(), {first, previous, corner});
    previous = corner;
  }
}

}  // namespace

void writeObj(const Mesh& mesh, OutputFile& file) {
  const bool normals = !mesh.normals.empty();
  Line line;
  line.append("# isostar");
  line.writeTo(file);
  writeVectors("v", mesh.positions, file);
  writeVectors("vn", mesh.normals, file);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    line.append("f");
    for (size_t corner = 0; corner < 3; ++corner) {
      line.append(" ");
      line.append(mesh.indices[i + corner] + uint64_t{1});
      if (!normals) continue;
      line.append("//");
      line.append(mesh.indices[i + corner] + uint64_t{1});
    }
    line.writeTo(file);
  }
}

Mesh readObj(std::span<const std::byte> bytes, const std::string& path) {
  Mesh mesh;
  bool known = false;
  for (WordReader reader(bytes); !reader.atEnd();) {
    std::string_view line = reader.line();
    const std::string_view keyword = nextWord(line);
    if (keyword == "v") readVertex(line, mesh, path);
    if (keyword == "f") readFace(line, mesh, path);
    known = known || keyword == "v" || keyword == "#" || keyword == "o" || keyword == "mtllib";
  }
  if (!known) throw Failure(path, "is not an OBJ file");
  return mesh;
}

}  // namespace isostar::native
