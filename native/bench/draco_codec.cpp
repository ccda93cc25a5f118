#include "bench/draco_codec.h"

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include <memory>

#include "files/failure.h"

namespace isostar::bench {
namespace {

[[noreturn]] void fail(const draco::Status& status) {
  throw native::Failure("draco", status.error_msg_string());
}

void fill(draco::Mesh& result, const Mesh& mesh) {
  const auto vertices = static_cast<uint32_t>(mesh.positions.size() / 3);
  result.set_num_points(vertices);
  draco::GeometryAttribute description;
  description.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false,
                   sizeof(float) * 3, 0);
  draco::PointAttribute& positions =
      *result.attribute(result.AddAttribute(description, true, vertices));
  for (uint32_t v = 0; v < vertices; ++v)
    positions.SetAttributeValue(draco::AttributeValueIndex(v), &mesh.positions[3 * size_t{v}]);
  result.SetNumFaces(mesh.indices.size() / 3);
  for (uint32_t f = 0; f < result.num_faces(); ++f) {
    const uint32_t* corners = &mesh.indices[3 * size_t{f}];
    result.SetFace(draco::FaceIndex(f),
                   {draco::PointIndex(corners[0]), draco::PointIndex(corners[1]),
                    draco::PointIndex(corners[2])});
  }
}

std::unique_ptr<draco::Mesh> decoded(std::span<const std::byte> bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok()) fail(mesh.status());
  return std::move(mesh).value();
}

}  // namespace

std::vector<std::byte> encodeDraco(const Mesh& mesh, int level, int bits) {
  draco::Mesh input;
  fill(input, mesh);
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
  encoder.SetSpeedOptions(10 - level, 10 - level);
  draco::EncoderBuffer buffer;
  if (const draco::Status status = encoder.EncodeMeshToBuffer(input, &buffer); !status.ok())
    fail(status);
  const auto* bytes = reinterpret_cast<const std::byte*>(buffer.data());
  return {bytes, bytes + buffer.size()};
}

size_t decodeDraco(std::span<const std::byte> bytes) {
  return decoded(bytes)->num_faces();
}

Mesh meshOfDraco(std::span<const std::byte> bytes) {
  const auto mesh = decoded(bytes);
  const draco::PointAttribute& positions =
      *mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  Mesh result;
  result.positions.resize(3 * size_t{mesh->num_points()});
  for (uint32_t p = 0; p < mesh->num_points(); ++p)
    positions.GetMappedValue(draco::PointIndex(p), &result.positions[3 * size_t{p}]);
  for (uint32_t f = 0; f < mesh->num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(f)))
      result.indices.push_back(corner.value());
  }
  return result;
}

}  // namespace isostar::bench
