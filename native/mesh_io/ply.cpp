#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <vector>

#include "files/failure.h"
#include "files/text.h"
#include "mesh_io/mesh_formats.h"
#include "mesh_io/word_reader.h"

static_assert(std::endian::native == std::endian::little,
              "binary meshes are copied from memory without conversion");

namespace isostar::native {
namespace {

enum class Type : uint8_t { I8, U8, I16, U16, I32, U32, F32, F64 };

struct Property {
  std::string name;
  Type type{};
  std::optional<Type> count;  // the type of a list's length; none for a single value
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;

  int find(std::string_view wanted) const {
    for (size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == wanted) return static_cast<int>(i);
    }
    return -1;
  }
};

struct Header {
  bool ascii = false;
  std::vector<Element> elements;
};

std::optional<Type> typeNamed(std::string_view name) {
  static constexpr std::array<std::array<const char*, 2>, 8> kNames = {{{"char", "int8"},
                                                                        {"uchar", "uint8"},
                                                                        {"short", "int16"},
                                                                        {"ushort", "uint16"},
                                                                        {"int", "int32"},
                                                                        {"uint", "uint32"},
                                                                        {"float", "float32"},
                                                                        {"double", "float64"}}};
  for (size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<Type>(i);
  }
  return {};
}

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::string& path) : reader_(bytes), path_(path) {}

  Mesh read() {
    readHeader();
    Mesh mesh;
    for (const Element& element : header_.elements) {
      if (element.name == "vertex") {
        readVertices(element, mesh);
      } else if (element.name == "face") {
        readFaces(element, mesh);
      } else {
        forEachRecord(element, [](auto&) {});
      }
    }
    return mesh;
  }

 private:
  using Record = std::vector<std::vector<double>>;  // the values of each property

  [[noreturn]] void fail(const std::string& what) const { throw Failure(path_, what); }

  void readHeader() {
    if (reader_.line() != "ply") fail("is not a PLY file");
    for (;;) {
      if (reader_.atEnd()) fail("ends inside its header");
      std::string_view line = reader_.line();
      const std::string_view word = nextWord(line);
      if (word == "end_header") break;
      if (word == "format") readFormat(nextWord(line));
      if (word == "element") readElement(line);
      if (word == "property") readProperty(line);
    }
  }

  void readFormat(std::string_view format) {
    header_.ascii = format == "ascii";
    if (!header_.ascii && format != "binary_little_endian")
      fail(text("has the format %s, which is not supported", std::string(format).c_str()));
  }

  void readElement(std::string_view line) {
    Element element;
    element.name = nextWord(line);
    if (!parseNumber(nextWord(line), element.count)) fail("has an element without a count");
    // Each record takes at least one byte unless it has no properties.
    if (element.count > reader_.left())
      fail(text("claims %llu records, more than it has bytes",
                static_cast<unsigned long long>(element.count)));
    header_.elements.push_back(std::move(element));
  }

  void readProperty(std::string_view line) {
    if (header_.elements.empty()) fail("has a property before any element");
    Property property;
    std::string_view type = nextWord(line);
    if (type == "list") {
      property.count = knownType(nextWord(line));
      type = nextWord(line);
    }
    property.type = knownType(type);
    property.name = nextWord(line);
    header_.elements.back().properties.push_back(std::move(property));
  }

  Type knownType(std::string_view name) const {
    if (const auto type = typeNamed(name)) return *type;
    fail(text("has a property of unknown type %s", std::string(name).c_str()));
  }

  template <class Visit>
  void forEachRecord(const Element& element, Visit visit) {
    Record record(element.properties.size());
    for (uint64_t i = 0; i < element.count && !record.empty(); ++i) {
      for (size_t p = 0; p < record.size(); ++p) readValues(element.properties[p], record[p]);
      visit(record);
    }
  }

  void readValues(const Property& property, std::vector<double>& values) {
    const double count = property.count ? readValue(*property.count) : 1;
    if (property.count && (!(count >= 0) || count > static_cast<double>(reader_.left())))
      fail(text("has a list of %g values, which is impossible", count));
    values.resize(static_cast<size_t>(count));
    for (double& value : values) value = readValue(property.type);
  }

  double readValue(Type type) {
    if (header_.ascii) {
      double value;
      if (!parseNumber(reader_.word(), value))
        fail("ends early, or has a word instead of a number");
      return value;
    }
    switch (type) {
      case Type::I8:
        return take<int8_t>();
      case Type::U8:
        return take<uint8_t>();
      case Type::I16:
        return take<int16_t>();
      case Type::U16:
        return take<uint16_t>();
      case Type::I32:
        return take<int32_t>();
      case Type::U32:
        return take<uint32_t>();
      case Type::F32:
        return take<float>();
      case Type::F64:
        return take<double>();
    }
    return 0;
  }

  template <class T>
  double take() {
    T value;
    if (!reader_.copy(&value, sizeof value)) fail("ends early");
    return value;
  }

  void readVertices(const Element& element, Mesh& mesh) {
    const std::array<int, 3> at = {element.find("x"), element.find("y"), element.find("z")};
    if (at[0] < 0 || at[1] < 0 || at[2] < 0) fail("has vertices without x, y and z");
    mesh.positions.reserve(3 * element.count);
    forEachRecord(element, [&](const Record& record) {
      for (int property : at)
        mesh.positions.push_back(
            record[property].empty() ? 0 : static_cast<float>(record[property][0]));
    });
  }

  void readFaces(const Element& element, Mesh& mesh) {
    int at = element.find("vertex_indices");
    if (at < 0) at = element.find("vertex_index");
    if (at < 0) fail("has faces without vertex_indices");
    mesh.indices.reserve(3 * element.count);
    forEachRecord(element, [&](const Record& record) {
      const auto& corners = record[at];
      for (size_t i = 2; i < corners.size(); ++i) {
        for (size_t corner : {size_t{0}, i - 1, i}) mesh.indices.push_back(index(corners[corner]));
      }
    });
  }

  uint32_t index(double value) const {
    if (!(value >= 0 && value <= UINT32_MAX)) fail(text("a face uses vertex %g", value));
    return static_cast<uint32_t>(value);
  }

  WordReader reader_;
  const std::string& path_;
  Header header_;
};

}  // namespace

void writePly(const Mesh& mesh, OutputFile& file) {
  const size_t vertices = mesh.positions.size() / 3, triangles = mesh.indices.size() / 3;
  const bool normals = !mesh.normals.empty();
  const std::string header = text(
      "ply\nformat binary_little_endian 1.0\ncomment isostar\nelement vertex %zu\n"
      "property float x\nproperty float y\nproperty float z\n%selement face %zu\n"
      "property list uchar int vertex_indices\nend_header\n",
      vertices, normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
      triangles);
  file.write(header.data(), header.size());
  for (size_t v = 0; v < vertices; ++v) {
    file.write(&mesh.positions[3 * v], 3 * sizeof(float));
    if (normals) file.write(&mesh.normals[3 * v], 3 * sizeof(float));
  }
  std::array<std::byte, 13> face{std::byte{3}};
  for (size_t t = 0; t < triangles; ++t) {
    std::memcpy(&face[1], &mesh.indices[3 * t], 12);
    file.write(face.data(), face.size());
  }
}

Mesh readPly(std::span<const std::byte> bytes, const std::string& path) {
  return Reader(bytes, path).read();
}

}  // namespace isostar::native
