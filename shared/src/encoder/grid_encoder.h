// The encoder in one dimension: checks options, quantizes the source and writes the smaller of its
// streams.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <optional>

#include "encoder/adaptive/encode_adaptive.h"
#include "encoder/core/quantization.h"
#include "encoder/uniform_layers.h"

namespace isostar {

/// Further isovalues in coding order: the next one is always that nearest to an isovalue coded
/// before.
inline std::vector<double> byNearness(double first, std::vector<double> others) {
  std::vector<double> coded{first};
  const auto distance = [&](double value) {
    double least = std::abs(value - first);
    for (const double t : coded) least = std::min(least, std::abs(value - t));
    return least;
  };
  while (!others.empty()) {
    const auto next = std::min_element(others.begin(), others.end(), [&](double a, double b) {
      return distance(a) < distance(b);
    });
    coded.push_back(*next);
    others.erase(next);
  }
  coded.erase(coded.begin());
  return coded;
}

/// Are all isovalues finite and different?
inline bool distinct(const EncodeOptions& options) {
  std::vector<double> all = options.furtherIsovalues;
  all.push_back(options.isovalue);
  if (!std::all_of(all.begin(), all.end(), [](double v) { return std::isfinite(v); })) return false;
  std::sort(all.begin(), all.end());
  return std::adjacent_find(all.begin(), all.end()) == all.end();
}

inline Error put(const Header& header, const CodedLayers& layers, const EncodeOptions& options,
                 std::vector<std::byte>& out) {
  layers.write(header, out);
  if (options.progress) options.progress(1);
  return Error::None;
}

/// The side of chunks, or 0. A surface with few vertices is one chunk: each chunk learns anew.
template <int D>
[[nodiscard]] int32_t chunkSideOf(const Header& header, const EncodeOptions& options) {
  constexpr uint64_t kFewestVertices = 200000;
  constexpr int32_t kSide = 128;
  const bool divisible =
      D == 3 && !header.keepsTopology && !header.trimmed && header.furtherIsovalues.empty();
  if (!divisible) return 0;
  if (options.chunkSide != EncodeOptions::kAutomatic) return options.chunkSide;
  return header.vertices < kFewestVertices ? 0 : kSide;
}

/// Are source and options valid, and can they be combined? `domain`: empty if it is the whole box.
template <int D>
bool valid(std::span<const float> samples, std::span<const float> domain,
           const Coordinates<D>& size, const Header& header, const EncodeOptions& options) {
  if (options.chunkSide != EncodeOptions::kAutomatic && options.chunkSide != 0 &&
      (options.chunkSide < EncodeOptions::kLeastChunkSide ||
       !std::has_single_bit(static_cast<uint32_t>(options.chunkSide))))
    return false;
  if (options.effort < 1 || options.effort > EncodeOptions::kMostEffort) return false;
  const bool bounded =
      options.lossless || (options.maxError > 0 && std::isfinite(options.maxError));
  if (options.preserveTopology && D != 3) return false;
  if (options.adaptive && (options.lossless || D == 4 || !options.furtherIsovalues.empty()))
    return false;
  if (!bounded || !invertible(header.placement) ||
      !sensible<D>(samples, size, options.isovalue, options.runTasks))
    return false;
  if (options.furtherIsovalues.size() > Header::kMostFurther || !distinct(options)) return false;
  return domain.empty() || (sensible<D>(domain, size, 0, options.runTasks) &&
                            !options.preserveTopology && options.furtherIsovalues.empty());
}

/// Sets the header's fields that follow from the options alone.
inline void setOptions(Header& header, const EncodeOptions& options) {
  header.isovalue = options.isovalue;
  header.furtherIsovalues = byNearness(options.isovalue, options.furtherIsovalues);
  header.polygonizer = options.polygonizer;
  header.lossless = options.lossless;
  header.keepsTopology = options.preserveTopology;
  header.fitted = options.effort > 1;
  header.maxError = options.lossless ? 0 : std::clamp(options.maxError, 1e-9, 1e9);
}

/// The distance that no vertex may exceed, grid steps: below what lossless means nothing is
/// promised.
[[nodiscard]] inline double boundOf(const Header& header) {
  return header.lossless ? kLosslessError : std::max(header.maxError, kLosslessError);
}

/// Encodes a source of any kind. `header`: has size and placement. `domain`: empty if it is the
/// whole box.
template <int D>
Error encodeGrid(std::span<const float> samples, std::span<const float> domain, Header header,
                 const EncodeOptions& options, std::vector<std::byte>& out, EncodeReport* report) {
  Coordinates<D> size;
  std::copy_n(header.size.begin(), D, size.begin());
  if (!valid<D>(samples, domain, size, header, options)) return Error::BadArgument;
  header.trimmed = !domain.empty();
  setOptions(header, options);
  if (header.trimmed && !header.lossless) header.maxError = boundOf(header);
  std::deque<Source<D>> sources;
  sources.emplace_back(samples, size, options.isovalue, options.runTasks);
  for (const double isovalue : header.furtherIsovalues)
    sources.emplace_back(samples, size, isovalue, options.runTasks);
  Precision precision;
  for (const Source<D>& source : sources)
    precision.add(source.precision(header.polygonizer), source.isovalue() - header.isovalue);
  precision.fix(header);
  chooseStep(header, boundOf(header) / kQuantizationShare, [&](const Header& stream) {
    double most = 0;
    for (const Source<D>& source : sources)
      most = std::max(most, quantizationError(stream, source));
    return most;
  });
  header.vertices = sources.front().crossings();
  std::optional<GridField<D>> end;
  if (header.trimmed) end.emplace(domain, size, 0);
  for (Source<D>& source : sources) source.measureIn(header, end ? &*end : nullptr);
  Header adaptiveHeader = header;
  CodedLayers adaptive;
  if constexpr (D < 4) {
    if (options.adaptive && !options.preserveTopology && !header.trimmed && header.vertices != 0) {
      adaptiveHeader.adaptive = true;
      if (!encodeAdaptive(sources.front().field(), options, sources.front().signs(), adaptiveHeader,
                          adaptive))
        adaptive = {};
    }
  }
  header.chunkSide = chunkSideOf<D>(header, options);
  std::optional<UniformWriter<D>> layers;
  double largest = 0;
  const auto code = [&] {
    layers.emplace(header, options, sources.front());
    largest = codeUniform(*layers, header, sources);
  };
  code();
  // What is assumed beyond the borders of chunks may be too far off.
  if (header.chunkSide != 0 && largest > boundOf(header)) {
    header.chunkSide = 0;
    code();
  }
  // Coarse simplices are used only if they are worth their bytes.
  if (report != nullptr) *report = {.maxError = boundOf(header)};
  if (adaptive.bytes() != 0 && adaptive.bytes() < layers->coded().bytes())
    return put(adaptiveHeader, adaptive, options, out);
  const bool holds = largest <= boundOf(header);
  if (report != nullptr) *report = {.maxError = largest, .holds = holds};
  // The distances to a domain's boundary are coded by the bound: it cannot be changed afterwards.
  if (!holds && (!options.bestEffort || header.trimmed)) return Error::BadArgument;
  if (!holds) header.lossless = false;
  if (!header.lossless && !header.trimmed) header.maxError = std::max(header.maxError, largest);
  return put(header, layers->coded(), options, out);
}

}  // namespace isostar
