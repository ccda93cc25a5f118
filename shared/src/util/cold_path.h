// Attributes for functions that rarely run and for innermost loops. ISOSTAR_COLD marks functions
// that run a few times per stream: in the WebAssembly decoder, which a page must download first,
// they are compiled for size, not for speed.
#pragma once

#ifdef __EMSCRIPTEN__
#define ISOSTAR_COLD [[clang::minsize, gnu::noinline]]
#define ISOSTAR_HOT
#else
#define ISOSTAR_COLD
#define ISOSTAR_HOT \
  [[gnu::always_inline]]  // for innermost loops: saves 1 % of decoding time, in WebAssembly nothing
#endif
