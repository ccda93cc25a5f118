// Functions that run a few times a stream: the WebAssembly decoder, which a page must load first, has them small, not fast.
#pragma once

#ifdef __EMSCRIPTEN__
#define ISOSTAR_SELDOM [[clang::minsize, gnu::noinline]]
#else
#define ISOSTAR_SELDOM
#endif
