// The raw module of default streams: RawDecoder by plain functions, which cost a page much less
// than Embind and its script. web/src/codec/plain-module.ts makes the interface of raw.ts of them.
#include "raw_decoder.h"

/// Exports the function that follows.
#define ISOSTAR_EXPORT(name) extern "C" [[gnu::used, clang::export_name(#name)]]

namespace {

using isostar::RawDecoder;

/// Where a result lies that is no number.
struct View {
  const void* begin = nullptr;
  std::size_t length = 0;  // in numbers
} view;

template <class Number>
const View* viewOf(std::span<const Number> numbers) {
  view = {numbers.data(), numbers.size()};
  return &view;
}

/// Appends numbers of any type.
template <class Numbers>
void append(std::vector<double>& out, const Numbers& numbers) {
  for (const auto number : numbers) out.push_back(double(number));
}

/// What a stream says of itself, as numbers in the order that plain-module.ts reads.
void describe(const isostar::StreamInfo& info, std::vector<double>& out) {
  using Doubles = std::initializer_list<double>;
  out.clear();
  append(out, Doubles{double(info.version), double(info.dimension)});
  append(out, info.size);
  append(out, info.placement.origin);
  append(out, info.placement.spacing);
  append(out, info.placement.direction);
  append(out, Doubles{double(info.polygonizer), double(info.lossless), double(info.effort),
                      double(info.chunkSide), info.maxError, double(info.vertices),
                      double(info.headerBytes), double(info.bytes), double(info.isovalues.size())});
  append(out, info.isovalues);
  for (const auto& layer : info.layers)
    append(out, Doubles{double(layer.kind[0]), double(layer.level), double(layer.offset),
                        double(layer.bytes), layer.error, double(layer.isovalue)});
}

}  // namespace

ISOSTAR_EXPORT(create)
RawDecoder* create(double memory, double samples, double vertices, double decisions) {
  return new RawDecoder(memory, samples, vertices, decisions);
}
ISOSTAR_EXPORT(delete) void destroy(RawDecoder* decoder) {
  delete decoder;
}

ISOSTAR_EXPORT(room) const View* makeRoom(RawDecoder* decoder, std::size_t n) {
  return viewOf(decoder->room(n));
}
ISOSTAR_EXPORT(accept) void acceptBytes(RawDecoder* decoder, std::size_t n, double offset) {
  decoder->accept(n, offset);
}
ISOSTAR_EXPORT(wantedBegin) double wantedBegin(const RawDecoder* decoder, double from) {
  return decoder->wantedBegin(from);
}
ISOSTAR_EXPORT(wantedEnd) double wantedEnd(const RawDecoder* decoder, double from) {
  return decoder->wantedEnd(from);
}
ISOSTAR_EXPORT(setRegion)
void setRegion(RawDecoder* decoder, double x0, double y0, double z0, double x1, double y1,
               double z1, isostar::Frame frame) {
  decoder->setRegion(x0, y0, z0, x1, y1, z1, frame);
}
ISOSTAR_EXPORT(setShare) void setShare(RawDecoder* decoder, int number, int of) {
  decoder->setShare(number, of);
}
ISOSTAR_EXPORT(needsOthers) bool needsOthers(const RawDecoder* decoder) {
  return decoder->needsOthers();
}
ISOSTAR_EXPORT(results) const View* results(RawDecoder* decoder) {
  return viewOf(decoder->results());
}
ISOSTAR_EXPORT(takeResults) bool takeResults(RawDecoder* decoder, std::size_t n) {
  return decoder->takeResults(n);
}
ISOSTAR_EXPORT(finish) void finish(RawDecoder* decoder) {
  decoder->finish();
}
ISOSTAR_EXPORT(advance) bool advance(RawDecoder* decoder) {
  return decoder->advance();
}
ISOSTAR_EXPORT(lacks) bool lacks(const RawDecoder* decoder) {
  return decoder->lacks();
}
ISOSTAR_EXPORT(isFinal) bool isFinal(const RawDecoder* decoder) {
  return decoder->isFinal();
}
ISOSTAR_EXPORT(level) int level(const RawDecoder* decoder) {
  return decoder->level();
}
ISOSTAR_EXPORT(levels) int levels(const RawDecoder* decoder) {
  return decoder->levels();
}
ISOSTAR_EXPORT(bytes) double bytes(const RawDecoder* decoder) {
  return decoder->bytes();
}
ISOSTAR_EXPORT(info) const View* info(const RawDecoder* decoder) {
  static std::vector<double> numbers;
  describe(decoder->info(), numbers);
  return viewOf(std::span<const double>(numbers));
}
ISOSTAR_EXPORT(error) const char* error(const RawDecoder* decoder) {
  return isostar::name(decoder->error());
}
ISOSTAR_EXPORT(describeError) const char* describeError(const RawDecoder* decoder) {
  return isostar::describe(decoder->error());
}
ISOSTAR_EXPORT(makeMesh)
const char* makeMesh(RawDecoder* decoder, isostar::Polygonizer polygonizer, isostar::Frame frame,
                     bool normals, double isovalue) {
  return isostar::name(decoder->makeMesh(polygonizer, frame, normals, isovalue));
}
ISOSTAR_EXPORT(positions) const View* positions(const RawDecoder* decoder) {
  return viewOf(decoder->positions());
}
ISOSTAR_EXPORT(normals) const View* normals(const RawDecoder* decoder) {
  return viewOf(decoder->normals());
}
ISOSTAR_EXPORT(indices) const View* indices(const RawDecoder* decoder) {
  return viewOf(decoder->indices());
}
ISOSTAR_EXPORT(runs) const View* runs(const RawDecoder* decoder) {
  return viewOf(decoder->runs());
}
