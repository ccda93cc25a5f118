// The decoder's state, behind an interface that hides the dimension of the stream.
#pragma once

#include <memory>

#include "container/stream.h"

namespace isostar {

class Reconstruction {
 public:
  virtual ~Reconstruction() = default;

  /// The result of a layer: its error, and whether the shown surface is better for it.
  struct Outcome {
    Error error = Error::None;
    bool better = false;
  };
  struct Section {
    std::span<const std::byte> bytes;
    bool isWanted = true;  // others are not decoded
    bool isOwn = true;     // others are decoded by other decoders
  };
  /// The sections of a layer, by chunk.
  using Sections = std::span<const Section>;
  /// `torn`: the last bytes of the layer are missing; no layer may follow. Then there may be fewer
  /// sections than the head names, and the last wanted one may be incomplete.
  virtual Outcome decode(const LayerHead& head, Sections sections, bool torn) = 0;

  /// The sections of layers in chunks are those of a share from now on; `isFirst`: of the first
  /// one.
  virtual void beShare(bool isFirst) { static_cast<void>(isFirst); }
  /// Are the chunks of the last complete level divided among shares?
  [[nodiscard]] virtual bool isDivided() const { return false; }
  /// Does the layer decoded last wait for the results of other shares? close() ends it: Corrupt if
  /// some did not come.
  [[nodiscard]] virtual bool isOpen() const { return false; }
  virtual Error close() { return Error::None; }
  /// What other shares need of this one, if anything, and its reverse; false if these are no such
  /// results.
  virtual void results(std::vector<std::byte>&) const {}
  [[nodiscard]] virtual bool take(std::span<const std::byte>) { return false; }

  /// The finest level that is complete, -1 before the first.
  [[nodiscard]] virtual int level() const = 0;

  /// BadArgument if streams of this dimension have no such output.
  virtual Error show(const MeshOptions& options, Mesh& out) const = 0;
  /// The part of a share, if the last level is divided.
  virtual Error show(const MeshOptions&, Mesh&, std::vector<MeshRun>&) const {
    return Error::BadArgument;
  }
  virtual Error show(const MeshOptions& options, Contours& out) const = 0;
};

/// `header` must be within the limits; it and `runTasks` must outlive the result. Null if this
/// build does not support the header's dimension.
[[nodiscard]] std::unique_ptr<Reconstruction> reconstructionOf(const Header& header,
                                                               const Limits& limits,
                                                               const RunTasks& runTasks);

/// The same for one dimension; each is compiled in a file of its own.
template <int D>
[[nodiscard]] std::unique_ptr<Reconstruction> reconstructionIn(const Header& header,
                                                               const Limits& limits,
                                                               const RunTasks& runTasks);
template <>
std::unique_ptr<Reconstruction> reconstructionIn<2>(const Header&, const Limits&, const RunTasks&);
template <>
std::unique_ptr<Reconstruction> reconstructionIn<3>(const Header&, const Limits&, const RunTasks&);
template <>
std::unique_ptr<Reconstruction> reconstructionIn<4>(const Header&, const Limits&, const RunTasks&);

}  // namespace isostar
