// Which streams a build decodes: the one switch of the page's two decoders.
#pragma once

namespace isostar {

/// False in the page's small decoder, which has the code of default streams alone: uniform
/// refinement of a volume, one isovalue, no domain, no preserved topology, effort 1, shown by
/// Polygonizer::Cubes. It refuses all others, and the page loads the decoder that has everything.
#ifdef ISOSTAR_DEFAULT_STREAMS
inline constexpr bool kDecodesAll = false;
#else
inline constexpr bool kDecodesAll = true;
#endif

}  // namespace isostar
