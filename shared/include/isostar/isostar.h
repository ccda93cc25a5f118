// isostar: isosurfaces of volume data, compressed and decoded progressively.
// After T. Lewiner, L. Velho, H. Lopes, V. Mello, Simplicial Isosurface Compression (2004); "§"
// cites its sections.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isostar {

inline constexpr int kFormatVersion = 1;  // encode() writes it; decoders read 1 … kFormatVersion

enum class Error : uint8_t {
  None,
  BadArgument,         // the caller's volume or options make no sense
  NotIsostar,          // the first bytes are not ours
  UnsupportedVersion,  // written by a newer format than this library reads, or in a dimension that
                       // this build lacks
  Truncated,           // more bytes were needed; feeding them may still succeed
  Corrupt,             // a checksum or a field cannot be true
  OverLimit,           // sound perhaps, but larger than the caller's Limits
};
const char* name(Error);      // the enumerator: "Corrupt"
const char* describe(Error);  // one English clause without a full stop

/// Which surface is made of the scalars (§3): one vertex per crossing axis edge, or one polygon per
/// crossing tetrahedron.
enum class Polygonizer : uint8_t { Cubes, Tetrahedra };

/// World applies the placement; Grid puts sample (i,j,k) at point (i,j,k).
enum class Frame : uint8_t { World, Grid };

/// world = origin + direction · (spacing ∘ index); direction is row-major and invertible, spacing
/// positive.
struct Placement {
  std::array<double, 3> origin{0, 0, 0}, spacing{1, 1, 1};
  std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

/// Samples on a regular grid, x fastest, borrowed for the length of the call. All must be finite.
/// A sample is positive where `sample > isovalue`.
struct Volume {
  std::span<const float> samples;
  std::array<int32_t, 3> size{0, 0, 0};
  Placement placement;
  /// Irregular data (§2): how far each sample lies from the boundary of the domain outside of which
  /// there is no field, in grid steps along the smallest spacing, positive inside; finite, exact up
  /// to a cell's diagonal. The surface ends there. Empty: the domain is the box. Samples outside
  /// continue the field by a cell's diagonal.
  std::span<const float> domain{};
};

/// Any function of a point in the world, for sampled().
using Field = std::function<double(double x, double y, double z)>;

/// The samples of a function on a volume's grid, x fastest; none where the size is not positive.
[[nodiscard]] std::vector<float> sampled(const Field&, const std::array<int32_t, 3>& size,
                                         const Placement& = {});

/// Samples of an image, x fastest, borrowed; what is encoded is its isocontours (§6).
struct Image {
  std::span<const float> samples;
  std::array<int32_t, 2> size{0, 0};
  std::array<double, 2> origin{0, 0}, spacing{1, 1};
};

/// Volumes one after the other, time slowest; their isosurfaces are encoded as one surface in four
/// dimensions (§6). Distances count a frame as one grid step.
struct Sequence {
  std::span<const float> samples;
  std::array<int32_t, 3> size{0, 0, 0};
  int32_t frames = 0;
  Placement placement;
};

struct EncodeOptions {
  double isovalue = 0;
  std::vector<double> furtherIsovalues;  // further isovalues on top of it (§5.4), at most 15, all
                                         // different; not with `adaptive`
  double maxError =
      0.05;  // bound on the two-sided distance, in grid steps along the smallest spacing
  bool lossless = false;  // the decoded surface is the one that the polygonizer makes of the source
  Polygonizer polygonizer =
      Polygonizer::Cubes;  // whose vertices' scalars are sent, and for which the bound holds
  bool adaptive = false;   // coarse simplices where they keep the bound (§4.3); not for sequences,
                           // lossless or near
  bool preserveTopology =
      false;  // every surface along the stream has the finest one's (§4.3); volumes only; not
              // combined with `adaptive`, which then makes no difference
  /// 1: what decodes at once; 2: scalars are predicted by least squares from all around (§6), which
  /// makes smooth surfaces' streams smaller by up to 18 %, and takes encoder and decoder longer.
  int effort = 1;
  static constexpr int kMostEffort = 2;
  std::function<void(double done)> progress;  // called now and then with 0 … 1
};

struct Mesh {
  std::vector<float> positions;  // x, y, z of each vertex
  std::vector<float> normals;    // unit, towards smaller values; empty where not asked for
  std::vector<uint32_t>
      indices;  // three vertices each, counter-clockwise seen from the side of smaller values
};

struct MeshOptions {
  Polygonizer polygonizer = Polygonizer::Cubes;
  Frame frame = Frame::World;
  bool normals = true;
  /// When to cut a sequence, in frames from 0. On a frame it is that frame's own surface; between
  /// two, that of the scalars in between. A volume's surface is the same at all times.
  double time = 0;
  /// Of a stream's surface: one of StreamInfo::isovalues or a value between two of them, which is
  /// then drawn from what is known; by default the first. Before an isovalue's own layers have come
  /// it is drawn from those told.
  std::optional<double> isovalue = std::nullopt;
};

/// Isocontours: polylines with larger values on their left, where y points up.
struct Contours {
  std::vector<float> points;  // x, y of each
  std::vector<uint32_t>
      starts;  // of each polyline in `points`, and where the last one ends; closed ones come last
  uint32_t open = 0;  // so many polylines begin and end at the image's border; of all others the
                      // last point joins the first
  bool positiveCorner =
      false;  // is the first sample positive? This tells the sides apart where no contour does
};

/// What a decoder may spend on a stranger's file. The defaults suit a browser tab.
struct Limits {
  uint64_t samples = 1ull << 31;   // of the grid
  uint64_t vertices = 1ull << 26;  // of a mesh
  /// Bytes that a decoder holds, with the surface while it is made. Beside them come the bytes fed,
  /// which are as many at most, and up to 4 MB of models.
  uint64_t memory = 3ull << 30;
};

/// One piece of the stream after which the decoded surface is better.
struct LayerInfo {
  std::string kind;     // "base", "refinement", "domain", "geometry"
  int level = 0;        // octave: 0 is the base, the last is the source's own grid
  uint64_t offset = 0;  // the layer is complete after this many bytes of the file
  uint64_t bytes = 0;   // of the layer alone
  double error = 0;  // RMS distance to the source's surface after it, in grid steps, as the encoder
                     // determined it
  int isovalue = 0;  // whose layer it is: an index into StreamInfo::isovalues; 0 is the first
};

/// What the header and the layers' own heads tell, without decoding.
struct StreamInfo {
  int version = 0;    // of the format, 1 … kFormatVersion
  int dimension = 3;  // 2: an image's contours; 3: a volume's surface; 4: a sequence's surface
  std::array<int32_t, 3> size{};  // an image's third is 1
  int32_t frames = 1;             // of a sequence
  Placement placement;
  std::vector<double>
      isovalues;  // the first one, then further ones in the order in which they are told
  Polygonizer polygonizer = Polygonizer::Cubes;
  bool lossless = false;
  bool adaptive = false;  // the mesh is coarser where that keeps the bound (§4.3)
  bool preservesTopology =
      false;                 // every layer's surface has the topology of the last one's (§4.3)
  int effort = 1;            // as in EncodeOptions: 2 takes longer to decode
  bool trimmed = false;      // the surface ends at the boundary of a domain inside the box (§2)
  double maxError = 0;       // the bound that was asked for; 0 for lossless
  uint64_t vertices = 0;     // of the complete surface that `cubes` makes, before it is trimmed
  uint64_t headerBytes = 0;  // header and the layer heads so far
  uint64_t bytes = 0;        // of the whole stream, as soon as its header has arrived
  std::vector<LayerInfo> layers;
};

/// Appends a stream to `out`; on an error `out` is as it was. A surface without vertices is a valid
/// stream. Of a volume with a domain, `near` and `preserveTopology` are a BadArgument, and
/// `adaptive` makes no difference.
[[nodiscard]] Error encode(const Volume&, const EncodeOptions&, std::vector<std::byte>& out);
[[nodiscard]] Error encode(const Image&, const EncodeOptions&, std::vector<std::byte>& out);
[[nodiscard]] Error encode(const Sequence&, const EncodeOptions&, std::vector<std::byte>& out);

/// Reads header and layer heads of a stream or of a prefix of one (then: the layers whose heads
/// have arrived).
[[nodiscard]] Error inspect(std::span<const std::byte>, StreamInfo& out);

/// The source's own surface, as encode() sees it.
[[nodiscard]] Error polygonize(const Volume&, double isovalue, const MeshOptions&, Mesh& out);
[[nodiscard]] Error polygonize(const Image&, double isovalue, const MeshOptions&, Contours& out);
[[nodiscard]] Error polygonize(const Sequence&, double isovalue, const MeshOptions&, Mesh& out);

/// A stream, a layer at a time, as its bytes arrive in pieces of any size. Any bytes are safe to
/// give.
class Decoder {
 public:
  explicit Decoder(const Limits& = {});
  ~Decoder();
  Decoder(Decoder&&) noexcept;
  Decoder& operator=(Decoder&&) noexcept;

  /// Copies. Never fails: more than Limits::memory becomes error(). Bytes past the stream's end,
  /// after an error or after finish() are not taken.
  void accept(std::span<const std::byte>);
  void finish();  // no more bytes will come: advance() then shows what a torn layer still tells
  /// Decodes one more layer. True: mesh() would show a better surface. False: feed more, or all is
  /// shown, or see error().
  [[nodiscard]] bool advance();
  /// The first error stays; Truncated only after finish(). advance() is false from then on; mesh()
  /// still shows what was sound.
  [[nodiscard]] Error error() const;

  [[nodiscard]] bool ready() const;  // the header has arrived, and this build reads such streams; a
                                     // surface, maybe empty, can be made
  [[nodiscard]] const StreamInfo& info()
      const;                        // header as far as it has arrived; layers so far decoded
  [[nodiscard]] int level() const;  // the octave that mesh() shows, -1 before the first
  [[nodiscard]] int levels()
      const;  // how many octaves the stream has, 0 before its header has arrived
  [[nodiscard]] uint64_t bytes() const;   // length of the prefix that mesh() shows
  [[nodiscard]] double rmsError() const;  // of the last complete layer, grid steps
  [[nodiscard]] bool isFinal() const;     // all layers are decoded

  /// Of a volume or of a sequence. Truncated: no header has arrived. OverLimit: it would take more
  /// than the limits. BadArgument: the stream is an image's, or has no such time or isovalue.
  [[nodiscard]] Error mesh(const MeshOptions&, Mesh& out) const;
  /// Of an image: marching squares (`cubes`), or one segment per crossing triangle (`tetrahedra`).
  /// BadArgument: the stream is none, or has no such isovalue.
  [[nodiscard]] Error contours(const MeshOptions&, Contours& out) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace isostar
