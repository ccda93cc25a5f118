#include "costly_kinds.h"

namespace isostar {
namespace {

Header costlyHeader(int dimension, const std::array<int32_t, 4>& size) {
  Header header;
  header.dimension = dimension;
  std::copy_n(size.begin(), 4, header.size.begin());
  header.countWhole(1);
  return header;
}

}  // namespace

std::vector<CostlyStream> costlyKinds(int32_t side) {
  const CostlyPass axes{LayerKind::Exponents},
      diagonals{LayerKind::Exponents, Members::DiagonalEnds}, halves{LayerKind::Magnitudes},
      displaced{LayerKind::Displacement},
      diagonalHalves{.kind = LayerKind::Magnitudes, .diagonals = true},
      nothing{.kind = LayerKind::Magnitudes, .most = 0, .diagonals = true};
  const int32_t frames = std::max(side / 4, 9), image = side * 8;
  CostlyStream volume;
  volume.header = costlyHeader(3, {side, side, side, 1});
  std::vector<CostlyStream> kinds;
  const auto add = [&](const char* name, CostlyStream stream, auto change) {
    stream.name = name;
    change(stream);
    kinds.push_back(std::move(stream));
  };
  add("one pass", volume, [&](auto& s) { s.passes = {axes, halves}, s.repeats = 1; });
  add("noise", volume, [&](auto& s) { s.passes = {axes, halves}, s.surprise = 0.1; });
  add("displacements", volume, [&](auto& s) { s.passes = {displaced}; });
  add("passes of all", volume, [&](auto& s) { s.passes = {axes, diagonals, diagonalHalves}; });
  add("passes of nothing", volume,
      [&](auto& s) { s.passes = {axes, diagonals, nothing, nothing, nothing, nothing}; });
  add("fitted", volume, [&](auto& s) {
    s.passes = {axes, diagonals, diagonalHalves}, s.header.fitted = true;
  });
  add("topology", volume, [&](auto& s) {
    s.passes = {axes, halves}, s.header.keepsTopology = true;
  });
  add("adaptive", volume, [&](auto& s) {
    s.passes = {axes, diagonalHalves}, s.header.adaptive = true;
  });
  add("trimmed", volume, [&](auto& s) { s.passes = {axes, halves}, s.header.trimmed = true; });
  const auto several = [&](auto& s) {
    for (int i = 1; i <= static_cast<int>(Header::kMostFurther); ++i)
      s.header.furtherIsovalues.push_back(i);
    s.furtherPasses = {axes, halves};
    s.repeats = 1;
  };
  add("further isovalues", volume, several);
  add("isovalues of nothing", volume, [&](auto& s) {
    several(s);
    s.noisy = 1;
    s.furtherPasses = {};
  });
  add("empty box", volume, [&](auto& s) {
    for (int32_t& n : std::span(s.header.size).first(3)) n *= 2;
    s.noisy = 1;
    s.noisyGeometry = 0;
    s.passes = {axes, halves, halves, halves, halves, halves};
  });
  CostlyStream sequence;
  sequence.header = costlyHeader(4, {frames, frames, frames, frames});
  add("sequence", sequence, [&](auto& s) { s.passes = {axes, diagonals, diagonalHalves}; });
  add("sequence of nothing", sequence,
      [&](auto& s) { s.passes = {axes, diagonals, nothing, nothing, nothing, nothing}; });
  add("fitted sequence", sequence, [&](auto& s) {
    s.passes = {axes, diagonals, diagonalHalves}, s.header.fitted = true;
  });
  add("sequence, isovalues", sequence, several);
  CostlyStream images;
  images.header = costlyHeader(2, {image, image, 1, 1});
  add("image", images, [&](auto& s) { s.passes = {axes, diagonals, diagonalHalves}; });
  add("image of nothing", images,
      [&](auto& s) { s.passes = {axes, diagonals, nothing, nothing, nothing, nothing}; });
  return kinds;
}

}  // namespace isostar
