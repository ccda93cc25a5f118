// Functions that run a few times a stream: the WebAssembly decoder, which a page must load first,
// has them small, not fast. And those of innermost loops.
#pragma once

#ifdef __EMSCRIPTEN__
#define ISOSTAR_COLD [[clang::minsize, gnu::noinline]]
#define ISOSTAR_OFTEN
#else
#define ISOSTAR_COLD
#define ISOSTAR_OFTEN \
  [[gnu::always_inline]]  // of an innermost loop: 1 % of decoding, but in WebAssembly none
#endif
