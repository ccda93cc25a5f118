// Collects the bytes of a stream, splits them into layers and passes these to a Reconstruction.
#pragma once

#include <optional>

#include "decoder/arrivals.h"
#include "decoder/chunk_choice.h"
#include "decoder/chunk_shares.h"
#include "decoder/reconstruction.h"
#include "decoder/stream_heads.h"
#include "util/decodes_all.h"

namespace isostar {

/// The state behind the public decoder.
struct StreamDecoder {
  StreamDecoder(const Limits& l, RunTasks run) : limits(l), runTasks(std::move(run)) {}

  void accept(std::span<const std::byte> bytes, uint64_t offset);
  bool advance();
  bool readHeader();
  void chooseLayers();
  void chooseBytes();
  Error nextHead();
  bool readHead();
  Error readPages(LayerHead& head, std::size_t layer, std::size_t from) const;
  bool findSections(const LayerHead& head, std::span<const std::byte> bytes);
  bool finishLayer();
  bool decodeTorn(const LayerHead& head, std::span<const std::byte> bytes);
  bool fail(Error e) {
    if (error == Error::None) error = e;
    return false;
  }
  /// Can a surface be made with these options?
  [[nodiscard]] Error shows(const MeshOptions& options) const {
    if (!reconstruction) return Error::Truncated;
    if (!kDecodesAll && options.polygonizer == Polygonizer::Tetrahedra) return Error::BadArgument;
    const Header& header = heads->header();
    return header.spans(options.isovalue.value_or(header.isovalue)) ? Error::None
                                                                    : Error::BadArgument;
  }
  [[nodiscard]] bool isFinal() const {
    return heads && (info.layers.size() == wantedLayers || heads->isEnd(at, info.layers.size()));
  }

  Limits limits;
  RunTasks runTasks;
  std::optional<Region> region;
  Share share;
  int awaited = 0;  // so many shares' results are needed before the layer in work ends
  Arrivals in;
  uint64_t accepted = 0;    // where the bytes given last end
  std::size_t at = 0;       // the end of what has been decoded, in `in`
  uint64_t offset = 0;      // the same in the stream
  std::size_t nextTry = 0;  // with fewer bytes than this the header is not read again
  std::vector<Reconstruction::Section> sections;  // of the layer in work, as far as they arrived
  bool finished = false;
  Error error = Error::None;
  std::optional<StreamHeads> heads;  // once header and index have arrived
  std::optional<ChunkChoice> choice;
  /// Up to which layer it is known what is wanted.
  struct {
    bool isOpen = false;    // is there one whose pages have not been read?
    std::size_t layer = 0;  // the first of these
    uint64_t start = 0;     // where in the stream its pages begin
    std::size_t at = 0;     // the same in `in`
    std::size_t pages = 0;  // bytes of its pages that are wanted
  } wants;
  std::optional<ChunkShares> shares;
  LayerHead inWork;  // the head of the layer in work
  bool isHeadRead = false;
  std::size_t headBytes = 0;   // of it, or of its pages, before the layer
  std::size_t headWanted = 0;  // of these: those that are wanted
  std::size_t wantedLayers = SIZE_MAX;
  StreamInfo info;
  bool tornShown = false;
  std::unique_ptr<Reconstruction> reconstruction;
  uint64_t shown = 0;
  double rms = 0;
};

}  // namespace isostar
