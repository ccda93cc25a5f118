#!/usr/bin/env bash
# The command line at build/isostar, the decoder as WebAssembly, the npm package in web/dist, the viewer in build/viewer.
# `build.sh test` adds the C++ tests.
set -euo pipefail
cd "$(dirname "$0")/.."

mkdir -p build
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi

cmake --preset release "${launcher[@]}" >build/configure.log 2>&1 || { cat build/configure.log >&2; exit 1; }
cmake --build --preset release --target "$([ "${1:-}" = test ] && echo all || echo isostar_cli)"
NODE_PATH=/usr/share/nodejs cmake --preset wasm >build/configure-wasm.log 2>&1 || { cat build/configure-wasm.log >&2; exit 1; }
NODE_PATH=/usr/share/nodejs cmake --build --preset wasm
npm run --silent --workspace web build
npx vite build web/viewer --config web/viewer/vite.config.ts --logLevel error
