// Runs the traversals of a recipe's layers without a source.
#include "costly_streams.h"

#include <bit>

#include "coding/adaptive/adaptive_field.h"
#include "coding/codec_state.h"
#include "expected_coder.h"
#include "stream_layout.h"

namespace isostar {
namespace {

template <int D>
GeometryPass<D> fieldsOf(const CostlyPass& p) {
  GeometryPass<D> pass{p.kind, p.members, p.range, {}, p.most, p.selective, {}};
  for (std::size_t axes = 1; axes < pass.allowed.size(); ++axes)
    pass.allowed[axes] = p.diagonals || std::has_single_bit(axes) ? p.allowed : 0;
  return pass;
}

template <int D>
class CostlyLayers {
 public:
  CostlyLayers(const CostlyStream& recipe, const Limits& limits)
      : recipe_(recipe), header_(recipe.header), left_(limits) {}

  Bytes stream() {
    if (header_.adaptive)
      adaptive();
    else
      uniform();
    return assembled(header_, layers_);
  }

 private:
  void uniform() {
    CodecState<D> state(header_);
    const auto add = [&](LayerKind kind, int level, const CostlyPass* pass) {
      const GeometryPass<D> fields = pass == nullptr ? GeometryPass<D>{} : fieldsOf<D>(*pass);
      return layer(
          {kind, level, 0.1, 0, 0}, pass == nullptr ? nullptr : &fields,
          [&](auto& exchange, const LayerHead& head) { state.code(exchange, head, fields); });
    };
    const int finest = header_.finestLevel();
    for (int level = 0; level <= finest; ++level)
      if (!add(level == 0 ? LayerKind::Base : LayerKind::Refinement, level, nullptr)) return;
    if (header_.trimmed && !add(LayerKind::Domain, finest, nullptr)) return;
    for (int i = 0; i < recipe_.repeats; ++i)
      for (const CostlyPass& pass : recipe_.passes)
        if (!add(pass.kind, finest, &pass)) return;
    for (int number = 1; number <= static_cast<int>(header_.furtherIsovalues.size()); ++number) {
      if (!add(LayerKind::FurtherSigns, number, nullptr)) return;
      for (int i = 0; i < recipe_.repeats; ++i)
        for (const CostlyPass& pass : recipe_.furtherPasses)
          if (!add(LayerKind::FurtherGeometry, number, &pass)) return;
    }
  }
  void adaptive() {
    if constexpr (D < 4) {
      AdaptiveField<D> field(header_.base<D>());
      const auto add = [&](LayerKind kind, int level, const CostlyPass* pass) {
        GeometryPass<D> fields = pass == nullptr ? GeometryPass<D>{} : fieldsOf<D>(*pass);
        fields.kind = kind;
        return layer(
            {kind, level, 0.1, 0, 0}, pass == nullptr ? nullptr : &fields,
            [&](auto& exchange, const LayerHead&) { field.code(exchange, fields, header_); });
      };
      const int finest = header_.finestLevel();
      for (int level = 0; level <= finest; ++level)
        if (!add(level == 0 ? LayerKind::Base : LayerKind::Refinement, level, nullptr)) return;
      for (int level = 0; level <= finest; ++level)
        for (const CostlyPass& pass : recipe_.passes)
          if (!add(pass.kind, level, &pass)) return;
    }
  }

  /// False if no more layers fit.
  template <class Code>
  bool layer(const LayerHead& head, const GeometryPass<D>* pass, Code code) {
    if (layers_.size() == kMostLayers) return false;
    Bytes bytes;
    ByteWriter out(bytes);
    if (head.kind == LayerKind::FurtherGeometry) out.u8(static_cast<uint64_t>(pass->kind));
    if (pass != nullptr) pass->write(out);
    Bytes coded;
    ExpectedCoder coder(coded, recipe_.seed + layers_.size(),
                        pass == nullptr ? recipe_.noisy : recipe_.noisyGeometry,
                        pass == nullptr ? recipe_.surprise : recipe_.surpriseGeometry);
    RangeDecoder unused({});
    ExpectedExchange<D> exchange(unused, coder, left_);
    code(exchange, head);
    coder.finish();
    bytes.insert(bytes.end(), coded.begin(), coded.end());
    layers_.push_back({head, bytes});
    left_.decisions -= std::min(left_.decisions, exchange.spent());
    return !exchange.exhausted();
  }

  const CostlyStream& recipe_;
  const Header& header_;
  Limits left_;
  std::vector<std::pair<LayerHead, Bytes>> layers_;
};

}  // namespace

Bytes assembled(const CostlyStream& recipe, const Limits& limits) {
  switch (recipe.header.dimension) {
    case 2:
      return CostlyLayers<2>(recipe, limits).stream();
    case 3:
      return CostlyLayers<3>(recipe, limits).stream();
    default:
      return CostlyLayers<4>(recipe, limits).stream();
  }
}

}  // namespace isostar
