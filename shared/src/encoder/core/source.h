// What the encoder knows of the source's surface at one isovalue.
#pragma once

#include <numeric>
#include <optional>

#include "encoder/core/bound_check.h"
#include "encoder/core/brick_tasks.h"
#include "encoder/core/quantized_field.h"
#include "encoder/core/source_distance.h"

namespace isostar {

/// The source's surface at one of the stream's isovalues.
template <int D>
class Source {
 public:
  /// `runTasks` must outlive it.
  Source(std::span<const float> samples, const Coordinates<D>& size, double isovalue,
         const RunTasks& runTasks)
      : isovalue_(isovalue),
        runTasks_(runTasks),
        field_(samples, size, isovalue),
        signs_(field_.signs(runTasks)),
        active_(activeBricks(signs_)) {}
  Source(const Source&) = delete;  // its parts refer to each other

  [[nodiscard]] double isovalue() const { return isovalue_; }
  [[nodiscard]] const GridField<D>& field() const { return field_; }
  [[nodiscard]] const Signs<D>& signs() const { return signs_; }
  [[nodiscard]] uint64_t crossings() const {
    const auto counts = ofBrickPieces(active_, runTasks_, [&](const BrickRange& range) {
      return countCrossings(signs_, active_, range);
    });
    return std::accumulate(counts.begin(), counts.end(), uint64_t{0});
  }
  [[nodiscard]] Precision precision(Polygonizer polygonizer) const {
    return field_.precision(polygonizer, signs_, active_, runTasks_);
  }
  /// As of quantizationError().
  [[nodiscard]] const std::vector<uint8_t>& active() const { return active_; }
  [[nodiscard]] const RunTasks& runTasks() const { return runTasks_; }
  /// Must be called once, when the stream's quantization step is fixed. `domain`: of a trimmed
  /// stream, otherwise null.
  void measureIn(const Header& stream, const GridField<D>* domain) {
    header_ = stream.at(isovalue_);
    quantized_.emplace(field_, header_, signs_, domain);
    distance_.emplace(field_, header_, signs_, active_);
  }
  [[nodiscard]] QuantizedField<D>& quantized() { return *quantized_; }
  [[nodiscard]] const SourceDistance<D>& distance() const { return *distance_; }
  [[nodiscard]] BoundCheck<D> check() const { return {field_, header_, runTasks_}; }

 private:
  double isovalue_;
  const RunTasks& runTasks_;
  GridField<D> field_;
  Signs<D> signs_;
  std::vector<uint8_t> active_;
  Header header_;
  std::optional<QuantizedField<D>> quantized_;
  std::optional<SourceDistance<D>> distance_;
};

}  // namespace isostar
