// The raw module that decodes everything: RawDecoder by Embind. web/src/codec/raw.ts declares it
// for TypeScript; stream-decoder.ts beside it is its only caller in the package.
#include <emscripten/bind.h>

#include "raw_decoder.h"

using emscripten::val;
using isostar::RawDecoder;

namespace {

// Not inlined, and for few types: the smaller module.

template <class Number>
[[gnu::noinline]] val arrayOf(const Number* begin, size_t length) {
  return val::array(begin, begin + length);
}
template <class Numbers>
val arrayOf(const Numbers& numbers) {
  return arrayOf(numbers.data(), numbers.size());
}
[[gnu::noinline]] void put(val& out, const char* name, const val& value) {
  out.set(name, value);
}
[[gnu::noinline]] void put(val& out, const char* name, double value) {
  put(out, name, val(value));
}

val describeLayer(const isostar::LayerInfo& layer, const std::vector<double>& isovalues) {
  val out = val::object();
  put(out, "kind", val(layer.kind));
  put(out, "level", layer.level);
  put(out, "offset", double(layer.offset));
  put(out, "bytes", double(layer.bytes));
  put(out, "error", layer.error);
  put(out, "isovalue", isovalues[size_t(layer.isovalue)]);
  return out;
}

val describeStream(const isostar::StreamInfo& info) {
  val out = val::object(), layers = val::array();
  for (const auto& layer : info.layers)
    layers.call<void>("push", describeLayer(layer, info.isovalues));
  put(out, "version", info.version);
  put(out, "dimension", info.dimension);
  put(out, "size", arrayOf(info.size));
  put(out, "origin", arrayOf(info.placement.origin));
  put(out, "spacing", arrayOf(info.placement.spacing));
  put(out, "direction", arrayOf(info.placement.direction));
  put(out, "isovalues", arrayOf(info.isovalues));
  put(out, "polygonizer",
      val(info.polygonizer == isostar::Polygonizer::Cubes ? "cubes" : "tetrahedra"));
  put(out, "lossless", val(info.lossless));
  put(out, "effort", info.effort);
  put(out, "chunkSide", info.chunkSide);
  put(out, "maxError", info.maxError);
  put(out, "vertices", double(info.vertices));
  put(out, "headerBytes", double(info.headerBytes));
  put(out, "bytes", double(info.bytes));
  put(out, "layers", layers);
  return out;
}

template <class Number>
val viewOf(std::span<const Number> numbers) {
  return val(emscripten::typed_memory_view(numbers.size(), numbers.data()));
}

val room(RawDecoder& decoder, size_t n) {
  return viewOf(decoder.room(n));
}
val results(RawDecoder& decoder) {
  return viewOf(decoder.results());
}
val info(const RawDecoder& decoder) {
  return describeStream(decoder.info());
}
std::string error(const RawDecoder& decoder) {
  return isostar::name(decoder.error());
}
std::string describeError(const RawDecoder& decoder) {
  return isostar::describe(decoder.error());
}
std::string makeMesh(RawDecoder& decoder, isostar::Polygonizer polygonizer, isostar::Frame frame,
                     bool normals, double isovalue) {
  return isostar::name(decoder.makeMesh(polygonizer, frame, normals, isovalue));
}
val positions(const RawDecoder& decoder) {
  return viewOf(decoder.positions());
}
val normals(const RawDecoder& decoder) {
  return viewOf(decoder.normals());
}
val indices(const RawDecoder& decoder) {
  return viewOf(decoder.indices());
}
val runs(const RawDecoder& decoder) {
  return viewOf(decoder.runs());
}

}  // namespace

/// Embind prints the addresses of types without names in its error messages. All types here have
/// names, so that the module need not contain printf.
extern "C" int __wrap_siprintf(char* out, const char*, ...) {
  *out = '\0';
  return 0;
}

EMSCRIPTEN_BINDINGS(isostar) {
  emscripten::enum_<isostar::Polygonizer>("Polygonizer")
      .value("cubes", isostar::Polygonizer::Cubes)
      .value("tetrahedra", isostar::Polygonizer::Tetrahedra);
  emscripten::enum_<isostar::Frame>("Frame")
      .value("world", isostar::Frame::World)
      .value("grid", isostar::Frame::Grid);

  emscripten::class_<RawDecoder>("Decoder")
      .constructor<double, double, double, double>()
      .function("room", &room)
      .function("accept", &RawDecoder::accept)
      .function("wantedBegin", &RawDecoder::wantedBegin)
      .function("wantedEnd", &RawDecoder::wantedEnd)
      .function("setRegion", &RawDecoder::setRegion)
      .function("setShare", &RawDecoder::setShare)
      .function("needsOthers", &RawDecoder::needsOthers)
      .function("results", &results)
      .function("takeResults", &RawDecoder::takeResults)
      .function("finish", &RawDecoder::finish)
      .function("advance", &RawDecoder::advance)
      .function("lacks", &RawDecoder::lacks)
      .function("isFinal", &RawDecoder::isFinal)
      .function("level", &RawDecoder::level)
      .function("levels", &RawDecoder::levels)
      .function("bytes", &RawDecoder::bytes)
      .function("info", &info)
      .function("error", &error)
      .function("describeError", &describeError)
      .function("makeMesh", &makeMesh)
      .function("positions", &positions)
      .function("normals", &normals)
      .function("indices", &indices)
      .function("runs", &runs);
}
