// The decoder as JavaScript sees it, without the words of a binding: numbers, and views of memory.
#pragma once

#include <isostar/isostar.h>

#include <algorithm>

namespace isostar {

/// JavaScript has one type of number. Views are valid until the next call.
class RawDecoder {
 public:
  /// The limits; NaN leaves the default, 2^63 and infinity mean none.
  RawDecoder(double memory, double samples, double vertices, double decisions)
      : decoder_(limitsOf({memory, samples, vertices, decisions})) {}

  /// `n` bytes to be filled immediately, before accept(n, …) or takeResults(n).
  std::span<const uint8_t> room(std::size_t n) {
    room_.resize(n);
    return room_;
  }
  /// `offset`: where in the stream the bytes begin.
  void accept(std::size_t n, double offset) {
    decoder_.accept(given(n), static_cast<uint64_t>(offset));
  }
  /// Of the first wanted bytes at `from` or after.
  [[nodiscard]] double wantedBegin(double from) const { return double(wanted(from).begin); }
  [[nodiscard]] double wantedEnd(double from) const { return double(wanted(from).end); }
  void setRegion(double x0, double y0, double z0, double x1, double y1, double z1, Frame frame) {
    static_cast<void>(decoder_.setRegion({{x0, y0, z0}, {x1, y1, z1}, frame}));
  }

  void setShare(int number, int of) { static_cast<void>(decoder_.setShare({number, of})); }
  [[nodiscard]] bool needsOthers() const { return decoder_.needsOthers(); }
  std::span<const uint8_t> results() {
    results_ = decoder_.results();
    return {reinterpret_cast<const uint8_t*>(results_.data()), results_.size()};
  }
  bool takeResults(std::size_t n) { return decoder_.takeResults(given(n)); }

  void finish() { decoder_.finish(); }
  /// Frees the last mesh first: decoding may need its memory.
  bool advance() {
    mesh_ = {};
    return decoder_.advance();
  }

  /// Is it a volume's stream that only the page's other decoder has the code of?
  [[nodiscard]] bool lacks() const {
    return decoder_.error() == Error::UnsupportedVersion && decoder_.levels() != 0 &&
           decoder_.info().dimension == 3;
  }
  [[nodiscard]] bool isFinal() const { return decoder_.isFinal(); }
  [[nodiscard]] int level() const { return decoder_.level(); }
  [[nodiscard]] int levels() const { return decoder_.levels(); }
  [[nodiscard]] double bytes() const { return double(decoder_.bytes()); }
  [[nodiscard]] const StreamInfo& info() const { return decoder_.info(); }
  [[nodiscard]] Error error() const { return decoder_.error(); }

  Error makeMesh(Polygonizer polygonizer, Frame frame, bool normals, double isovalue) {
    MeshOptions options{polygonizer, frame, normals};
    options.isovalue = isovalue;
    return decoder_.mesh(options, mesh_, runs_);
  }
  [[nodiscard]] std::span<const float> positions() const { return mesh_.positions; }
  [[nodiscard]] std::span<const float> normals() const { return mesh_.normals; }
  [[nodiscard]] std::span<const uint32_t> indices() const { return mesh_.indices; }
  /// Four numbers a run: those of MeshRun.
  [[nodiscard]] std::span<const uint32_t> runs() const {
    return {reinterpret_cast<const uint32_t*>(runs_.data()), runs_.size() * 4};
  }

 private:
  static Limits limitsOf(const std::array<double, 4>& wanted) {
    Limits limits;
    const std::array<uint64_t*, 4> all{&limits.memory, &limits.samples, &limits.vertices,
                                       &limits.decisions};
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (wanted[i] >= 0) *all[i] = static_cast<uint64_t>(std::min(wanted[i], 0x1p63));
    }
    return limits;
  }
  [[nodiscard]] ByteRange wanted(double from) const {
    return decoder_.wanted(static_cast<uint64_t>(from));
  }
  [[nodiscard]] std::span<const std::byte> given(std::size_t n) const {
    return std::as_bytes(std::span(room_).first(n));
  }

  Decoder decoder_;
  std::vector<uint8_t> room_;
  Mesh mesh_;
  std::vector<MeshRun> runs_;
  std::vector<std::byte> results_;
};

}  // namespace isostar
