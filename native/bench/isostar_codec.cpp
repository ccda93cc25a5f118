#include "bench/isostar_codec.h"

namespace isostar::bench {
namespace {

std::vector<std::byte> encoded(const Subject& subject, const EncodeOptions& options) {
  std::vector<std::byte> stream;
  require(encode(subject.volume.view(), options, stream), "encode");
  return stream;
}

EncodeOptions boundedBy(double maxError, const Subject& subject) {
  EncodeOptions options;
  options.isovalue = subject.isovalue;
  options.maxError = maxError;
  options.effort = subject.effort;
  return options;
}

}  // namespace

std::vector<std::byte> encodeIsostar(const Subject& subject, double maxError,
                                     const RunTasks& runTasks) {
  EncodeOptions options = boundedBy(maxError, subject);
  options.runTasks = runTasks;
  return encoded(subject, options);
}

std::vector<std::byte> encodeIsostarInChunks(const Subject& subject, double maxError, int side) {
  EncodeOptions options = boundedBy(maxError, subject);
  options.chunkSide = side;
  return encoded(subject, options);
}

std::vector<std::byte> encodeIsostarAdaptive(const Subject& subject, double maxError) {
  EncodeOptions options = boundedBy(maxError, subject);
  options.adaptive = true;
  return encoded(subject, options);
}

std::vector<std::byte> encodeIsostarOfOneTopology(const Subject& subject, double maxError) {
  EncodeOptions options = boundedBy(maxError, subject);
  options.preserveTopology = true;
  return encoded(subject, options);
}

std::vector<std::byte> encodeIsostarWith(const Subject& subject, double further, double maxError) {
  EncodeOptions options = boundedBy(maxError, subject);
  options.furtherIsovalues = {further};
  return encoded(subject, options);
}

std::vector<std::byte> encodeIsostarLossless(const Subject& subject) {
  EncodeOptions options;
  options.isovalue = subject.isovalue;
  options.effort = subject.effort;
  options.lossless = true;
  return encoded(subject, options);
}

Decoder decodeIsostar(std::span<const std::byte> prefix, const RunTasks& runTasks) {
  Decoder decoder({}, runTasks);
  decoder.accept(prefix);
  decoder.finish();
  while (decoder.advance()) {
  }
  if (decoder.error() != Error::Truncated) require(decoder.error(), "decode");
  return decoder;
}

Mesh meshOf(const Decoder& decoder, bool normals) {
  Mesh mesh;
  require(decoder.mesh({.frame = Frame::Grid, .normals = normals}, mesh), "polygonize");
  return mesh;
}

}  // namespace isostar::bench
