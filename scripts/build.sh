#!/usr/bin/env bash
# Builds the command line at build/isostar, the decoder as WebAssembly, the npm package in web/dist
# and the viewer in build/viewer, and records versions in build/packages.txt. `build.sh test` adds
# the C++ tests.
set -euo pipefail
cd "$(dirname "$0")/.."

mkdir -p build
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi

# Prints the log only if configuring fails.
configure() {
  local log=build/configure-$1.log
  cmake --preset "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
}

configure release "${launcher[@]}"
cmake --build --preset release --target "$([ "${1:-}" = test ] && echo all || echo isostar_cli)"
# Debian's Emscripten finds its Node modules by NODE_PATH.
NODE_PATH=/usr/share/nodejs configure wasm
NODE_PATH=/usr/share/nodejs cmake --build --preset wasm
npm run --silent --workspace web build
npx vite build web/viewer --config web/viewer/vite.config.ts --logLevel error
bash scripts/record-packages.sh
