// The raw WebAssembly module: the public C++ API, under the same names. web/src/codec/raw.ts
// declares it for TypeScript; web/src/codec/session.ts is its only caller in the package.
#include <emscripten/bind.h>

#include <isostar/isostar.h>

using emscripten::val;

namespace {

template <class Numbers>
val arrayOf(const Numbers& numbers) {
  return val::array(numbers.begin(), numbers.end());
}

/// A view into this module's memory, valid until the next call into the module.
template <class Number>
val viewOf(const std::vector<Number>& numbers) {
  return val(emscripten::typed_memory_view(numbers.size(), numbers.data()));
}

val describeLayer(const isostar::LayerInfo& layer, const std::vector<double>& isovalues) {
  val out = val::object();
  out.set("kind", layer.kind);
  out.set("level", layer.level);
  out.set("offset", double(layer.offset));
  out.set("bytes", double(layer.bytes));
  out.set("error", layer.error);
  out.set("isovalue", isovalues[size_t(layer.isovalue)]);
  return out;
}

val describeStream(const isostar::StreamInfo& info) {
  val out = val::object(), layers = val::array();
  for (const auto& layer : info.layers)
    layers.call<void>("push", describeLayer(layer, info.isovalues));
  out.set("version", info.version);
  out.set("dimension", info.dimension);
  out.set("size", arrayOf(info.size));
  out.set("origin", arrayOf(info.placement.origin));
  out.set("spacing", arrayOf(info.placement.spacing));
  out.set("direction", arrayOf(info.placement.direction));
  out.set("isovalues", arrayOf(info.isovalues));
  out.set("polygonizer",
          std::string(info.polygonizer == isostar::Polygonizer::Cubes ? "cubes" : "tetrahedra"));
  out.set("lossless", info.lossless);
  out.set("effort", info.effort);
  out.set("maxError", info.maxError);
  out.set("vertices", double(info.vertices));
  out.set("headerBytes", double(info.headerBytes));
  out.set("bytes", double(info.bytes));
  out.set("layers", layers);
  return out;
}

class RawDecoder {
 public:
  /// A view of n bytes of this module's memory, to be filled immediately, before accept(n).
  val room(size_t n) {
    room_.resize(n);
    return viewOf(room_);
  }
  void accept(size_t n) { decoder_.accept(std::as_bytes(std::span(room_).first(n))); }
  void finish() { decoder_.finish(); }
  bool advance() { return decoder_.advance(); }

  bool ready() const { return decoder_.ready(); }
  bool isFinal() const { return decoder_.isFinal(); }
  int level() const { return decoder_.level(); }
  int levels() const { return decoder_.levels(); }
  double bytes() const { return double(decoder_.bytes()); }
  double rmsError() const { return decoder_.rmsError(); }
  val info() const { return describeStream(decoder_.info()); }
  std::string error() const { return isostar::name(decoder_.error()); }
  std::string describeError() const { return isostar::describe(decoder_.error()); }

  std::string makeMesh(isostar::Polygonizer polygonizer, isostar::Frame frame, bool normals,
                       double isovalue) {
    isostar::MeshOptions options{polygonizer, frame, normals};
    options.isovalue = isovalue;
    return isostar::name(decoder_.mesh(options, mesh_));
  }
  val positions() const { return viewOf(mesh_.positions); }
  val normals() const { return viewOf(mesh_.normals); }
  val indices() const { return viewOf(mesh_.indices); }

 private:
  isostar::Decoder decoder_;
  std::vector<uint8_t> room_;
  isostar::Mesh mesh_;
};

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
      .constructor<>()
      .function("room", &RawDecoder::room)
      .function("accept", &RawDecoder::accept)
      .function("finish", &RawDecoder::finish)
      .function("advance", &RawDecoder::advance)
      .function("ready", &RawDecoder::ready)
      .function("isFinal", &RawDecoder::isFinal)
      .function("level", &RawDecoder::level)
      .function("levels", &RawDecoder::levels)
      .function("bytes", &RawDecoder::bytes)
      .function("rmsError", &RawDecoder::rmsError)
      .function("info", &RawDecoder::info)
      .function("error", &RawDecoder::error)
      .function("describeError", &RawDecoder::describeError)
      .function("makeMesh", &RawDecoder::makeMesh)
      .function("positions", &RawDecoder::positions)
      .function("normals", &RawDecoder::normals)
      .function("indices", &RawDecoder::indices);
}
