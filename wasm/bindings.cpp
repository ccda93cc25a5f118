// The raw WebAssembly module: the public C++ API, under the same names. web/src/codec/raw.ts
// declares it for TypeScript; stream-decoder.ts beside it is its only caller in the package.
#include <emscripten/bind.h>

#include <isostar/isostar.h>

#include <algorithm>

using emscripten::val;

namespace {

// Not inlined, and for few types: the smaller module. JavaScript has one type of number.

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

/// A view into this module's memory, valid until the next call into the module.
template <class Number>
val viewOf(const std::vector<Number>& numbers) {
  return val(emscripten::typed_memory_view(numbers.size(), numbers.data()));
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

/// A limit from JavaScript. NaN leaves the default; 2^63 and infinity mean no limit.
void setLimit(uint64_t& limit, double wanted) {
  if (wanted >= 0) limit = static_cast<uint64_t>(std::min(wanted, 0x1p63));
}

isostar::Limits limitsOf(double memory, double samples, double vertices, double decisions) {
  isostar::Limits limits;
  setLimit(limits.memory, memory);
  setLimit(limits.samples, samples);
  setLimit(limits.vertices, vertices);
  setLimit(limits.decisions, decisions);
  return limits;
}

class RawDecoder {
 public:
  RawDecoder(double memory, double samples, double vertices, double decisions)
      : decoder_(limitsOf(memory, samples, vertices, decisions)) {}

  /// A view of n bytes of this module's memory, to be filled immediately, before accept(n, …).
  val room(size_t n) {
    room_.resize(n);
    return viewOf(room_);
  }
  /// `offset`: where in the stream the bytes begin.
  void accept(size_t n, double offset) { decoder_.accept(given(n), static_cast<uint64_t>(offset)); }
  /// Of the first wanted bytes at `from` or after.
  double wantedBegin(double from) const { return double(wanted(from).begin); }
  double wantedEnd(double from) const { return double(wanted(from).end); }
  std::string setRegion(double x0, double y0, double z0, double x1, double y1, double z1,
                        isostar::Frame frame) {
    return isostar::name(decoder_.setRegion({{x0, y0, z0}, {x1, y1, z1}, frame}));
  }

  std::string setShare(int number, int of) {
    return isostar::name(decoder_.setShare({number, of}));
  }
  bool needsOthers() const { return decoder_.needsOthers(); }
  /// Valid until the next call.
  val results() {
    results_ = decoder_.results();
    return val(emscripten::typed_memory_view(results_.size(),
                                             reinterpret_cast<const uint8_t*>(results_.data())));
  }
  bool takeResults(size_t n) { return decoder_.takeResults(given(n)); }

  void finish() { decoder_.finish(); }
  /// Frees the last mesh first: decoding may need its memory.
  bool advance() {
    mesh_ = {};
    return decoder_.advance();
  }

  bool isFinal() const { return decoder_.isFinal(); }
  int level() const { return decoder_.level(); }
  int levels() const { return decoder_.levels(); }
  double bytes() const { return double(decoder_.bytes()); }
  val info() const { return describeStream(decoder_.info()); }
  std::string error() const { return isostar::name(decoder_.error()); }
  std::string describeError() const { return isostar::describe(decoder_.error()); }

  std::string makeMesh(isostar::Polygonizer polygonizer, isostar::Frame frame, bool normals,
                       double isovalue) {
    isostar::MeshOptions options{polygonizer, frame, normals};
    options.isovalue = isovalue;
    return isostar::name(decoder_.mesh(options, mesh_, runs_));
  }
  val positions() const { return viewOf(mesh_.positions); }
  val normals() const { return viewOf(mesh_.normals); }
  val indices() const { return viewOf(mesh_.indices); }
  /// Four numbers a run: those of MeshRun.
  val runs() const {
    return val(emscripten::typed_memory_view(runs_.size() * 4,
                                             reinterpret_cast<const uint32_t*>(runs_.data())));
  }

 private:
  isostar::ByteRange wanted(double from) const {
    return decoder_.wanted(static_cast<uint64_t>(from));
  }
  std::span<const std::byte> given(size_t n) const {
    return std::as_bytes(std::span(room_).first(n));
  }

  isostar::Decoder decoder_;
  std::vector<uint8_t> room_;
  isostar::Mesh mesh_;
  std::vector<isostar::MeshRun> runs_;
  std::vector<std::byte> results_;
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
      .constructor<double, double, double, double>()
      .function("room", &RawDecoder::room)
      .function("accept", &RawDecoder::accept)
      .function("wantedBegin", &RawDecoder::wantedBegin)
      .function("wantedEnd", &RawDecoder::wantedEnd)
      .function("setRegion", &RawDecoder::setRegion)
      .function("setShare", &RawDecoder::setShare)
      .function("needsOthers", &RawDecoder::needsOthers)
      .function("results", &RawDecoder::results)
      .function("takeResults", &RawDecoder::takeResults)
      .function("finish", &RawDecoder::finish)
      .function("advance", &RawDecoder::advance)
      .function("isFinal", &RawDecoder::isFinal)
      .function("level", &RawDecoder::level)
      .function("levels", &RawDecoder::levels)
      .function("bytes", &RawDecoder::bytes)
      .function("info", &RawDecoder::info)
      .function("error", &RawDecoder::error)
      .function("describeError", &RawDecoder::describeError)
      .function("makeMesh", &RawDecoder::makeMesh)
      .function("positions", &RawDecoder::positions)
      .function("normals", &RawDecoder::normals)
      .function("indices", &RawDecoder::indices)
      .function("runs", &RawDecoder::runs);
}
