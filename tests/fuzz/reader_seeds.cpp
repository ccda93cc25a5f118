#include "reader_seeds.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "mesh_io/mesh_file.h"
#include "native/dicom_element.h"
#include "property/sampled_field.h"
#include "seed_folder.h"

namespace isostar {
namespace {

using native::bytesOf;
using native::element;

/// The samples of the volumes: 2 × 3 × 4, with a surface between them.
template <class Value>
std::string samples() {
  return bytesOf(native::counting<Value>(24));
}

std::string words(int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += std::to_string(i) + " ";
  return all;
}

std::string nrrdHeader(const std::string& type, const std::string& encoding,
                       const std::string& more = "") {
  return "NRRD0004\ntype: " + type +
         "\ndimension: 3\nsizes: 2 3 4\nspace: left-posterior-superior\n"
         "space directions: (0.5,0,0) (0,2,0) (0,0,3)\nspace origin: (1,2,3)\nendian: little\n"
         "encoding: " +
         encoding + "\n" + more + "\n";
}

void writeNrrd(SeedFolder seeds) {
  seeds.write(nrrdHeader("short", "raw") + samples<int16_t>());
  seeds.write(nrrdHeader("float", "raw") + samples<float>());
  seeds.write(nrrdHeader("uchar", "ascii") + words(24));
  seeds.write(nrrdHeader("uchar", "hex") + "000102030405060708090a0b0c0d0e0f1011121314151617");
  seeds.write(
      "NRRD0001\ntype: double\ndimension: 4\nsizes: 2 3 2 2\nspacings: 1 2 3 nan\n"
      "endian: little\nencoding: raw\nkey:=value\n# comment\n\n" +
      samples<double>());
  seeds.write(nrrdHeader("ushort", "raw", "line skip: 1\nbyte skip: 2\n") + "line\nab" +
              samples<uint16_t>());
}

std::string metaHeader(const std::string& type, const std::string& more = "") {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n" +
         more +
         "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 10 20 30\nElementSpacing = 0.5 2 3\n"
         "DimSize = 2 3 4\nElementType = MET_" +
         type + "\nElementDataFile = LOCAL\n";
}

void writeMetaImages(SeedFolder seeds) {
  seeds.write(metaHeader("SHORT") + samples<int16_t>());
  seeds.write(metaHeader("FLOAT", "CompressedData = False\nHeaderSize = 0\n") + samples<float>());
  seeds.write(metaHeader("UCHAR", "CenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\n") +
              samples<uint8_t>());
}

/// A NIfTI-1 header for 2 × 3 × 4 samples.
std::string niftiHeader(int16_t type, int16_t bits, bool affine) {
  std::string header(352, '\0');
  const auto put = [&](std::size_t at, const auto& value) {
    std::memcpy(&header[at], &value, sizeof value);
  };
  put(0, int32_t{348});
  put(40, std::array<int16_t, 8>{3, 2, 3, 4, 1, 1, 1, 1});
  put(70, type);
  put(72, bits);
  put(76, std::array<float, 4>{1, 1, 1, 2});
  put(108, 352.0F);
  put(112, std::array<float, 2>{2, -3});
  if (affine) {
    put(254, int16_t{1});
    put(280, std::array<float, 12>{2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30});
  }
  std::memcpy(&header[344], "n+1", 4);
  return header;
}

void writeNifti(SeedFolder seeds) {
  seeds.write(niftiHeader(4, 16, true) + samples<int16_t>());
  seeds.write(niftiHeader(16, 32, false) + samples<float>());
  seeds.write(niftiHeader(2, 8, true) + samples<uint8_t>());
}

/// Pages of 2 × 3 samples, one strip of bytes each.
std::string tiff(int pages, uint16_t components) {
  std::string file = std::string("II*\0", 4) + std::string(4, '\0');
  std::size_t link = 4;
  const auto bytes = static_cast<uint32_t>(6 * components);
  for (int page = 0; page < pages; ++page) {
    const auto strip = static_cast<uint32_t>(file.size());
    for (uint32_t i = 0; i < bytes; ++i) file += static_cast<char>(page * 6 + static_cast<int>(i));
    file.replace(link, 4, bytesOf(static_cast<uint32_t>(file.size())));
    const auto entry = [](uint16_t tag, uint16_t type, uint32_t value) {
      return bytesOf(tag) + bytesOf(type) + bytesOf(uint32_t{1}) + bytesOf(value);
    };
    file += bytesOf(uint16_t{9}) + entry(256, 4, 2) + entry(257, 4, 3) + entry(258, 3, 8) +
            entry(259, 3, 1) + entry(262, 3, components == 3 ? 2 : 1) + entry(273, 4, strip) +
            entry(277, 3, components) + entry(278, 4, 3) + entry(279, 4, bytes);
    link = file.size();
    file += std::string(4, '\0');
  }
  return file;
}

void writeTiff(SeedFolder seeds) {
  seeds.write(tiff(4, 1));
  seeds.write(tiff(1, 1));
  seeds.write(tiff(1, 3));
  // BigTIFF: an empty directory.
  seeds.write(std::string("II+\0\x08\0\0\0", 8) + bytesOf(uint64_t{16}) + std::string(16, '\0'));
}

/// The input of the target: type, three sizes, samples.
void writeRaw(SeedFolder seeds) {
  const std::string size({'\1', '\1', '\1', '\2', '\1', '\3'});
  seeds.write('\3' + size + samples<int16_t>());
  seeds.write('\x8' + size + samples<float>());
  seeds.write('\0' + size + samples<uint8_t>());
}

void writeNamedFiles(SeedFolder seeds) {
  seeds.write("NRRD0004\ndimension: 3\ndata file: v%03d.raw 1 10 1\n\n");
  seeds.write("NRRD0004\ndatafile: LIST\na.raw\nb.raw\n");
  seeds.write("NDims = 3\nElementDataFile = LIST 2D\na.raw\nb.raw\n");
  seeds.write("NDims = 3\nElementDataFile = v%2i.raw 10 1 -1\n");
  seeds.write("NDims = 3\nElementDataFile = /dev/zero\n");
}

Mesh ball() {
  const Size size{5, 5, 5};
  Mesh mesh;
  (void)polygonize(sampled("ball", size, sphere(size)).volume(), 0, {}, mesh);
  return mesh;
}

void writeMeshes(const std::filesystem::path& folder) {
  Mesh mesh = ball();
  for (const char* format : {"ply", "obj", "stl", "glb"}) {
    SeedFolder seeds(folder / format);
    for (const bool normals : {true, false}) {
      if (!normals) mesh.normals.clear();
      const std::string path = seeds.next("." + std::string(format));
      native::writeMesh(mesh, path);
    }
    mesh = ball();
  }
  SeedFolder(folder / "ply" / "text")
      .write(
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty double y\n"
          "property int z\nproperty list uchar short w\nelement face 1\n"
          "property list uchar uint vertex_index\nend_header\n0 0 0 0\n1 0 0 1 7\n0 1 0 0\n"
          "3 0 1 2\n");
  SeedFolder(folder / "stl" / "text")
      .write(
          "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
          "endloop\nendfacet\nendsolid a\n");
  SeedFolder(folder / "obj" / "text")
      .write("# a\no b\nv 0 0 0\nv 1e0 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nf 1/1/1 2//1 -1 3\n");
}

/// A CT slice of 2 × 3 shorts.
std::string dicom() {
  const std::string ct = "1.2.840.10008.5.1.4.1.1.2", instance = "1.2.3.4.1";
  const std::string meta = element(2, 1, "OB", std::string("\0\1", 2)) + element(2, 2, "UI", ct) +
                           element(2, 3, "UI", instance) +
                           element(2, 16, "UI", "1.2.840.10008.1.2.1");
  return std::string(128, '\0') + "DICM" +
         element(2, 0, "UL", bytesOf(static_cast<uint32_t>(meta.size()))) + meta +
         element(8, 0x16, "UI", ct) + element(8, 0x18, "UI", instance) +
         element(8, 0x60, "CS", "CT") + element(0x20, 0x0d, "UI", "1.2") +
         element(0x20, 0x0e, "UI", "1.2.3") + element(0x20, 0x13, "IS", "1") +
         element(0x20, 0x32, "DS", "0\\0\\0") + element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0") +
         element(0x28, 2, 1) + element(0x28, 4, "CS", "MONOCHROME2") + element(0x28, 0x10, 3) +
         element(0x28, 0x11, 2) + element(0x28, 0x30, "DS", "0.5\\0.25") +
         element(0x28, 0x100, 16) + element(0x28, 0x101, 16) + element(0x28, 0x102, 15) +
         element(0x28, 0x103, 1) + element(0x28, 0x1052, "DS", "0") +
         element(0x28, 0x1053, "DS", "1") +
         element(0x7fe0, 0x10, "OW", bytesOf(native::counting<int16_t>(6)));
}

std::string vti() {
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
         "<ImageData WholeExtent=\"1 2 0 2 0 3\" Origin=\"10 20 30\" Spacing=\"0.5 2 3\">\n"
         "<Piece Extent=\"1 2 0 2 0 3\"><PointData Scalars=\"s\"><DataArray type=\"Int16\" "
         "Name=\"s\" format=\"ascii\" NumberOfComponents=\"1\">" +
         words(24) + "</DataArray></PointData></Piece></ImageData></VTKFile>\n";
}

std::string vtu() {
  const auto array = [](const std::string& attributes, const std::string& values) {
    return "<DataArray format=\"ascii\" " + attributes + ">" + values + "</DataArray>";
  };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\"><UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" "
         "NumberOfCells=\"2\"><PointData>" +
         array("type=\"Float32\" Name=\"t\"", "1 2 -3 4 5") + "</PointData><Points>" +
         array("type=\"Float64\" NumberOfComponents=\"3\"", "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1") +
         "</Points><Cells>" + array("type=\"Int64\" Name=\"connectivity\"", "0 1 2 3 1 2 3 4") +
         array("type=\"Int64\" Name=\"offsets\"", "4 8") +
         array("type=\"UInt8\" Name=\"types\"", "10 10") +
         "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

std::string legacyHead(const std::string& set) {
  return "# vtk DataFile Version 3.0\nseed\nASCII\nDATASET " + set + "\n";
}

void writeForChildren(const std::filesystem::path& folder) {
  SeedFolder(folder / "dicom").write(dicom(), ".dcm");
  SeedFolder vtk(folder / "vtk");
  vtk.write(vti(), ".vti");
  vtk.write(vtu(), ".vtu");
  vtk.write(legacyHead("STRUCTURED_POINTS") +
                "DIMENSIONS 2 3 4\nORIGIN 1 2 3\nSPACING 0.5 2 3\nPOINT_DATA 24\n"
                "SCALARS s float 1\nLOOKUP_TABLE default\n" +
                words(24) + "\n",
            ".vtk");
  vtk.write(legacyHead("UNSTRUCTURED_GRID") +
                "POINTS 5 float\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\nCELLS 2 10\n4 0 1 2 3\n"
                "4 1 2 3 4\nCELL_TYPES 2\n10\n10\nPOINT_DATA 5\nSCALARS t float 1\n"
                "LOOKUP_TABLE default\n1 2 -3 4 5\n",
            ".vtk");
}

}  // namespace

void writeReaderSeeds(const std::filesystem::path& folder) {
  writeNrrd(SeedFolder(folder / "nrrd"));
  writeMetaImages(SeedFolder(folder / "meta_image"));
  writeNifti(SeedFolder(folder / "nifti"));
  writeTiff(SeedFolder(folder / "tiff"));
  writeRaw(SeedFolder(folder / "raw"));
  writeNamedFiles(SeedFolder(folder / "named_files"));
  writeMeshes(folder);
  writeForChildren(folder);
}

}  // namespace isostar
