// The source in the quantization steps of one stream, with the encoder's decisions for a pass.
#pragma once

#include <algorithm>
#include <vector>

#include "encoder/core/expected_distortion.h"
#include "encoder/core/field.h"
#include "scalars/displacements.h"

namespace isostar {

/// A sample's distance to the domain's boundary in the stream's steps, rounded down, within ± the
/// header's domainReach().
template <int D>
[[nodiscard]] int32_t domainSteps(const GridField<D>& domain, const Header& header,
                                  std::size_t brickIndex, std::size_t r, int x) {
  const int32_t reach = header.domainReach();
  return static_cast<int32_t>(
      std::clamp(std::floor(domain.scalar(brickIndex, r, x) * header.domainFineness()),
                 double(-reach), double(reach - 1)));
}

/// What an EncoderExchange queries: scalars in the quantization steps of one stream, and the
/// encoder's decisions for the current pass.
template <int D>
class QuantizedField {
 public:
  /// `domain`: of a trimmed stream, otherwise null.
  QuantizedField(const GridField<D>& field, const Header& header, const Signs<D>& signs,
                 const GridField<D>* domain = nullptr)
      : field_(field), header_(header), signs_(signs), domain_(domain) {}
  void select(std::vector<uint8_t> marked) { selected_ = std::move(marked); }
  /// May values other than the actual ones be coded from now on?
  void setRdoq(bool on) { rdoq_ = on; }
  [[nodiscard]] bool usesRdoq() const { return rdoq_; }
  /// Sets the displacements to code in the next pass, in its steps.
  void displace(Displacements<D> steps) { displacements_ = std::move(steps); }
  [[nodiscard]] uint32_t magnitude(std::size_t brickIndex, std::size_t r, int x) const {
    return field_.magnitude(header_, brickIndex, r, x);
  }
  /// The distortion for EncoderExchange::rdoqTarget(). Empty while the actual magnitudes are coded.
  template <class CodedAt, class Allowed>
  [[nodiscard]] CrossingDistortion<D> distortion(std::size_t brickIndex, std::size_t r, int x,
                                                 CodedAt codedAt, const Allowed& allowed) const {
    if (!rdoq_) return {};
    return ExpectedDistortion<D>(field_, header_).around(brickIndex, r, x, codedAt, allowed);
  }
  [[nodiscard]] int gradient(std::size_t brickIndex) const {
    return field_.gradient(header_, signs_, brickIndex);
  }
  [[nodiscard]] int32_t domain(std::size_t brickIndex, std::size_t r, int x) const {
    return domainSteps(*domain_, header_, brickIndex, r, x);
  }
  [[nodiscard]] int displacement(std::size_t brickIndex, std::size_t block) const {
    return displacements_.at(brickIndex)[block];
  }
  [[nodiscard]] bool selected(std::size_t brickIndex) const { return selected_[brickIndex] != 0; }

 private:
  const GridField<D>& field_;
  const Header& header_;
  const Signs<D>& signs_;
  const GridField<D>* domain_;
  std::vector<uint8_t> selected_;
  Displacements<D> displacements_;
  bool rdoq_ = false;
};

}  // namespace isostar
