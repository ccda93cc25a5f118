// Public interface of isostar: encodes isosurfaces of regular grids and decodes them progressively.
//
// After T. Lewiner, L. Velho, H. Lopes, V. Mello, Simplicial Isosurface Compression (2004); "§"
// cites its sections.
//
// Three kinds of source are supported: an Image (2D, isocontours), a Volume (3D, an isosurface) and
// a Sequence of volumes (4D, §6). Distances and errors are in grid steps: multiples of the smallest
// spacing. Spans are borrowed for the length of a call. Functions report expected failures by an
// Error; they do not throw for bad arguments or bad bytes.
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

/// The version of the format that encode() writes. Decoders read versions 1 … kFormatVersion.
inline constexpr int kFormatVersion = 1;

enum class Error : uint8_t {
  None,
  /// The caller's source or options violate the contract below.
  BadArgument,
  /// The first bytes are not those of an isostar stream.
  NotIsostar,
  /// The stream's format is newer than this library reads, or this build lacks its dimension.
  UnsupportedVersion,
  /// More bytes are needed; the same call may succeed once they have arrived.
  Truncated,
  /// A checksum is wrong, or a field has an impossible value.
  Corrupt,
  /// Possibly sound, but larger than the caller's Limits.
  OverLimit,
};
/// The name of the enumerator: "Corrupt". A string literal.
const char* name(Error);
/// One English clause without a full stop. A string literal.
const char* describe(Error);

/// How a caller runs pieces of work that do not depend on each other: calls task(0) … task(count -
/// 1), each once, in any order and on any threads, and returns when all have returned. A task may
/// call it again. Results do not depend on it. Empty: one after the other.
using RunTasks =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// Which surface is made of the scalars (§3). Cubes: one vertex per crossing axis edge, as in
/// marching cubes (marching squares for images). Tetrahedra: one polygon per crossing tetrahedron
/// of the RBMT (one segment per crossing triangle).
enum class Polygonizer : uint8_t { Cubes, Tetrahedra };

/// The frame of positions and normals. World applies the source's Placement; Grid puts sample
/// (i, j, k) at point (i, j, k).
enum class Frame : uint8_t { World, Grid };

/// Where a grid lies in the world: world = origin + direction · (spacing ∘ index). `direction` is
/// row-major, each column is the direction of an axis. Spacings must be positive, all numbers
/// finite and `direction` invertible. Values far outside of single precision's range are rejected:
/// origins beyond ±1e30, spacings outside 1e-20 … 1e20, columns of a length outside 1e-6 … 1e6.
struct Placement {
  std::array<double, 3> origin{0, 0, 0}, spacing{1, 1, 1};
  std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

/// Samples on a regular grid. The product of the sizes must be the number of samples; each size is
/// 1 … 2^28 - 1. With a size of 1 on some axis there is no surface.
struct Volume {
  /// x fastest; all finite. A sample is positive where `sample > isovalue`.
  std::span<const float> samples;
  std::array<int32_t, 3> size{0, 0, 0};
  Placement placement;
  /// For data that do not fill the box (§2): the distance of each sample from the boundary of the
  /// domain, in grid steps, positive inside, in the order of `samples`. All finite; exact up to the
  /// diagonal of a cell. The surface ends at the boundary; samples outside must continue the field
  /// by the diagonal of a cell. Empty: the domain is the box.
  std::span<const float> domain{};
};

/// A function of a point in world coordinates, for sampled().
using Field = std::function<double(double x, double y, double z)>;

/// The values of a function at the samples of a volume with this size and placement, x fastest.
/// Empty if a size is not positive.
[[nodiscard]] std::vector<float> sampled(const Field&, const std::array<int32_t, 3>& size,
                                         const Placement& = {});

/// Samples of an image, of which isocontours are encoded (§6). Contracts are those of Volume.
struct Image {
  std::span<const float> samples;
  std::array<int32_t, 2> size{0, 0};
  std::array<double, 2> origin{0, 0}, spacing{1, 1};
};

/// Volumes at `frames` times, x fastest and time slowest. Their isosurfaces are encoded as one
/// surface in four dimensions (§6), in which a frame counts as one grid step. Contracts are those
/// of Volume, for four axes.
struct Sequence {
  std::span<const float> samples;
  std::array<int32_t, 3> size{0, 0, 0};
  int32_t frames = 0;
  Placement placement;
};

/// Options of encode(). Combinations that are named as not allowed are a BadArgument.
struct EncodeOptions {
  /// Finite.
  double isovalue = 0;
  /// Further isovalues, coded on top of the first one (§5.4): at most 15, finite, all different
  /// from each other and from `isovalue`. Not with `adaptive`, and not for a Volume with a domain.
  std::vector<double> furtherIsovalues;
  /// The bound: the largest two-sided distance between the decoded surface and the source's, in
  /// grid steps. Finite and positive; unused if `lossless`.
  double maxError = 0.05;
  /// The decoded surface is the one that `polygonizer` makes of the source: exactly if the samples
  /// are whole numbers of 1 or of 1/255, otherwise within 2^-14 grid steps.
  bool lossless = false;
  /// The polygonizer whose vertices' scalars are coded, and for which the bound holds. The other
  /// one shows such a stream, too, but without the bound.
  Polygonizer polygonizer = Polygonizer::Cubes;
  /// An adaptive mesh: coarse simplices where they keep the bound (§4.3), if that makes the stream
  /// smaller. Not for a Sequence, and not with `lossless` or `furtherIsovalues`. Has no effect on a
  /// Volume with a domain.
  bool adaptive = false;
  /// Every surface along the stream has the topology of the finest one (§4.3). Only for a Volume
  /// without a domain. `adaptive` then has no effect.
  bool preserveTopology = false;
  /// 1: fast to decode. 2: scalars are predicted by least squares from all around (§6). This makes
  /// streams of smooth surfaces smaller by up to 18 %, and takes encoder and decoder longer.
  int effort = 1;
  static constexpr int kMostEffort = 2;
  /// Writes a stream that does not hold the bound instead of none. Its header then states the bound
  /// that it holds. Not for a Volume with a domain.
  bool bestEffort = false;
  /// The side, in cells, of the chunks into which each refinement level is divided, a power of two
  /// from 16 on; 0: none. Chunks are decoded side by side, and smaller ones cost more bytes. By
  /// default a surface with many vertices has chunks of 128. Has no effect where there are none:
  /// with `preserveTopology` or `furtherIsovalues`, for an Image, a Sequence and a Volume with a
  /// domain, and in adaptive streams.
  int chunkSide = kAutomatic;
  static constexpr int kAutomatic = -1, kLeastChunkSide = 16;
  /// How to use several threads. Bytes do not depend on it.
  RunTasks runTasks;
  /// Called now and then with a fraction 0 … 1, by the thread that called encode(). May be empty.
  std::function<void(double done)> progress;
};

/// What encode() measured on the surface that it decoded.
struct EncodeReport {
  /// The largest distance between decoded surface and source, both ways, in grid steps: at each
  /// vertex exactly. Of a domain's boundary and of adaptive streams it is the bound.
  double maxError = 0;
  /// Is that within the bound?
  bool holds = true;
};

/// An indexed triangle mesh.
struct Mesh {
  /// x, y, z of each vertex.
  std::vector<float> positions;
  /// x, y, z of each vertex's unit normal, which points to smaller values. Empty if not requested.
  std::vector<float> normals;
  /// Three vertices per triangle, counter-clockwise seen from the side of smaller values.
  std::vector<uint32_t> indices;
};

/// How polygonize() and Decoder make a mesh or contours.
struct MeshOptions {
  Polygonizer polygonizer = Polygonizer::Cubes;
  Frame frame = Frame::World;
  /// Compute Mesh::normals; contours have none.
  bool normals = true;
  /// For sequences: the time of the surface, in frames, 0 … frames - 1. On a frame it is that
  /// frame's own surface; between two frames, that of interpolated scalars. Ignored for others.
  double time = 0;
  /// For streams: one of StreamInfo::isovalues, or a value between two of them, whose surface is
  /// estimated from the coded ones. Before the layers of an isovalue are decoded, its surface is
  /// estimated from the isovalues decoded so far. By default the first isovalue. polygonize() takes
  /// the isovalue as an argument and ignores this one.
  std::optional<double> isovalue = std::nullopt;
};

/// Isocontours as polylines, with larger values on their left where y points up.
struct Contours {
  /// x, y of each point.
  std::vector<float> points;
  /// The index in `points` / 2 at which each polyline starts, and at the end where the last one
  /// ends. Open polylines come first, closed ones last.
  std::vector<uint32_t> starts;
  /// How many polylines are open: they start and end at the image's border. All others are closed:
  /// their last point is joined to their first.
  uint32_t open = 0;
  /// Is the first sample positive? Without a contour this is the sign of the whole image.
  bool positiveCorner = false;
};

/// A box along the axes of a frame, its boundary included.
struct Region {
  std::array<double, 3> least{0, 0, 0}, most{0, 0, 0};
  Frame frame = Frame::World;
};

/// One of several decoders of a stream, which together make its surface: number 0 … of - 1.
struct Share {
  int number = 0, of = 1;
};

/// Vertices and triangles of a share that follow each other in the whole mesh, too. Runs of all
/// shares, sorted by `order`, make the whole: each begins with the vertex `firstVertex`, and its
/// corners follow those of the run before.
struct MeshRun {
  uint32_t order = 0, firstVertex = 0, vertices = 0, corners = 0;
};

/// Bytes of a stream: begin … end - 1.
struct ByteRange {
  uint64_t begin = 0, end = 0;
};

/// What a decoder may spend on untrusted input. The defaults suit a browser tab.
struct Limits {
  /// Samples of the source's grid, all frames together.
  uint64_t samples = 1ull << 31;
  /// Vertices of a mesh, or points of contours.
  uint64_t vertices = 1ull << 26;
  /// Bytes that a decoder uses, including the mesh while it is made. Not included are up to 4 MB
  /// of models, and the bytes given to accept(): three times as many while their copy grows.
  uint64_t memory = 512ull << 20;
  /// Yes/no decisions that are decoded. Other work of decoding counts as many as take as long: 64
  /// for each visit of a brick of a volume. A few bytes can hold very many. A decoder does about 30
  /// million in a second.
  uint64_t decisions = 1ull << 28;
};

/// One layer: a piece of the stream after which the decoded surface is better.
struct LayerInfo {
  /// "base", "refinement", "domain" or "geometry".
  std::string kind;
  /// The refinement level that the layer belongs to: 0 is the base, the last is the source's grid.
  int level = 0;
  /// The number of bytes from the start of the stream to the end of the layer.
  uint64_t offset = 0;
  /// The layer's own bytes, with its checksums.
  uint64_t bytes = 0;
  /// The RMS distance to the source's surface after the layer, in grid steps, as measured by the
  /// encoder.
  double error = 0;
  /// The isovalue that the layer belongs to: an index into StreamInfo::isovalues, 0 is the first.
  int isovalue = 0;
};

/// What a stream's header says.
struct StreamInfo {
  /// The version of the format, 1 … kFormatVersion.
  int version = 0;
  /// 2: an image's contours; 3: a volume's surface; 4: a sequence's surface.
  int dimension = 3;
  /// The size of the source's grid; an image's third is 1.
  std::array<int32_t, 3> size{};
  /// The number of frames of a sequence, else 1.
  int32_t frames = 1;
  Placement placement;
  /// The first isovalue, then further ones in the order in which they are coded.
  std::vector<double> isovalues;
  /// The options of encode(), of which `adaptive` is set only if the mesh is adaptive.
  Polygonizer polygonizer = Polygonizer::Cubes;
  bool lossless = false;
  bool adaptive = false;
  bool preservesTopology = false;
  int effort = 1;
  /// The surface ends at the boundary of a domain inside the box (§2).
  bool trimmed = false;
  /// Cells of a chunk on a side; 0 if each level is one chunk.
  int chunkSide = 0;
  /// The bound, in grid steps; 0 if lossless.
  double maxError = 0;
  /// Vertices of the final surface of the first isovalue that Polygonizer::Cubes makes, before it
  /// is trimmed.
  uint64_t vertices = 0;
  /// Bytes of the header with its index.
  uint64_t headerBytes = 0;
  /// Bytes of the whole stream; known as soon as the header has arrived.
  uint64_t bytes = 0;
  std::vector<LayerInfo> layers;
};

/// Encodes a source as a stream and appends it to `out`. A surface without vertices is a valid
/// stream. BadArgument: the source or the options violate their contracts, or the bound cannot be
/// held; `out` is then unchanged. `report`, if not null, says which, and what was measured: scalars
/// have 29 bits, too few for samples that differ much in size, such as fill values beside a
/// surface.
[[nodiscard]] Error encode(const Volume&, const EncodeOptions&, std::vector<std::byte>& out,
                           EncodeReport* report = nullptr);
[[nodiscard]] Error encode(const Image&, const EncodeOptions&, std::vector<std::byte>& out,
                           EncodeReport* report = nullptr);
[[nodiscard]] Error encode(const Sequence&, const EncodeOptions&, std::vector<std::byte>& out,
                           EncodeReport* report = nullptr);

/// Reads the header of a stream or of a prefix of one, without decoding. `out.layers` has all
/// layers, whether or not they have arrived. Truncated: the header has not arrived. NotIsostar,
/// UnsupportedVersion or Corrupt: as in Error. On an error `out` is unchanged.
[[nodiscard]] Error inspect(std::span<const std::byte>, StreamInfo& out);

/// The surface of the source itself, as encode() sees it: the reference for distances, and what a
/// lossless stream decodes to, within 2^-14 grid steps of the samples' own. BadArgument: the source
/// violates its contract, its samples differ so much in size that this cannot be held, the isovalue
/// is not finite or, for a Sequence, options.time is outside 0 … frames - 1. OverLimit: more
/// vertices than 32-bit indices can count. On an error the contents of `out` are unspecified.
[[nodiscard]] Error polygonize(const Volume&, double isovalue, const MeshOptions&, Mesh& out);
[[nodiscard]] Error polygonize(const Image&, double isovalue, const MeshOptions&, Contours& out);
[[nodiscard]] Error polygonize(const Sequence&, double isovalue, const MeshOptions&, Mesh& out);

/// Decodes a stream layer by layer while its bytes arrive in pieces of any size. Any bytes are safe
/// to give it (untrusted input).
///
/// Call accept() as bytes arrive, then advance() until it returns false; mesh() or contours() may
/// be called at any time in between. Call finish() when no more bytes will come. A decoder must not
/// be used by two threads at the same time. A moved-from decoder may only be destroyed or assigned
/// to.
class Decoder {
 public:
  /// `runTasks`: used within calls of this decoder's methods only.
  explicit Decoder(const Limits& = {}, RunTasks runTasks = {});
  ~Decoder();
  Decoder(Decoder&&) noexcept;
  Decoder& operator=(Decoder&&) noexcept;

  /// Decodes a stream in chunks at full precision in a region only, and elsewhere on coarse levels:
  /// within the region vertices are those of the whole stream. Other streams are decoded as a
  /// whole. To be called before accept(). BadArgument: a number is not finite, a side of the box
  /// is negative, or bytes were accepted before.
  [[nodiscard]] Error setRegion(const Region&);

  /// Decodes a part of the chunks of a stream in chunks, other decoders the others: in other
  /// threads, workers or machines. All get the same bytes, region and limits. Whenever advance()
  /// returns false and needsOthers(), and before each mesh() after a layer of geometry, each must
  /// take the results of all others. Other streams are decoded as a whole by each. To be called
  /// before accept(). BadArgument: the number is out of range, or bytes were accepted before.
  [[nodiscard]] Error setShare(const Share&);
  /// Has the share decoded its part of a layer, so that advance() goes on when it has the results
  /// of all other shares?
  [[nodiscard]] bool needsOthers() const;
  /// What other shares need of this one now; empty if that is nothing.
  [[nodiscard]] std::vector<std::byte> results() const;
  /// Takes results() of another share of the same stream in the same state. Any bytes are safe;
  /// false: they are no such results.
  [[nodiscard]] bool takeResults(std::span<const std::byte>);

  /// Copies the next bytes of the stream, as far as they are wanted(). If they exceed
  /// Limits::memory, error() becomes OverLimit. Bytes past the stream's end, after an error, or
  /// after finish() are ignored.
  void accept(std::span<const std::byte>);
  /// The same for bytes that begin at `offset` in the stream, so that bytes that are not wanted
  /// need not be read. They are ignored from the first wanted byte on that is missing.
  void accept(std::span<const std::byte>, uint64_t offset);
  /// The next bytes that are needed, of those at `from` or after; empty if there are none. Before
  /// the header and the index have arrived it is not known how many these are: then some more.
  [[nodiscard]] ByteRange wanted(uint64_t from = 0) const;
  /// States that no more bytes will come: advance() then decodes what it can of a torn layer.
  void finish();
  /// Decodes at most one more layer. True: mesh() and contours() would show a better surface.
  /// False: more bytes are needed, all is decoded (isFinal()), or there is an error().
  [[nodiscard]] bool advance();
  /// The first error, which stays; Truncated occurs only after finish(). After an error advance()
  /// returns false, and mesh() and contours() still show what was sound.
  [[nodiscard]] Error error() const;

  /// Has the header arrived, and does this build read such streams? Then mesh() or contours() can
  /// be called; before the base is decoded they give an empty surface.
  [[nodiscard]] bool ready() const;
  /// The header, once it has arrived, and the layers decoded so far.
  [[nodiscard]] const StreamInfo& info() const;
  /// The refinement level of the decoded surface; -1 before the base is decoded.
  [[nodiscard]] int level() const;
  /// How many refinement levels the stream has; 0 before its header has arrived.
  [[nodiscard]] int levels() const;
  /// The length of the prefix of the stream that is decoded, in bytes.
  [[nodiscard]] uint64_t bytes() const;
  /// LayerInfo::error of the last whole layer that is decoded; 0 before the first.
  [[nodiscard]] double rmsError() const;
  /// Are all layers of the stream decoded, as far as they are wanted?
  [[nodiscard]] bool isFinal() const;

  /// The decoded surface of a volume or of a sequence. Truncated: not ready(). OverLimit: it would
  /// exceed the Limits. BadArgument: the stream is an image's, options.time is outside its frames,
  /// or options.isovalue outside the range of its isovalues. On an error `out` is empty. Does not
  /// change error().
  [[nodiscard]] Error mesh(const MeshOptions&, Mesh& out) const;
  /// The part of the surface of this decoder's share, in the same order, with the numbers of
  /// vertices in the whole mesh.
  [[nodiscard]] Error mesh(const MeshOptions&, Mesh& out, std::vector<MeshRun>& runs) const;
  /// The decoded contours of an image. BadArgument: the stream is not an image's, or
  /// options.isovalue is outside the range of its isovalues. Otherwise as mesh().
  [[nodiscard]] Error contours(const MeshOptions&, Contours& out) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace isostar
