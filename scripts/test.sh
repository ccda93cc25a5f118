#!/usr/bin/env bash
# Every test: C++, Node, browser. Each runner ends with its own summary.
set -euo pipefail
cd "$(dirname "$0")/.."

ctest --preset release -j2
npx tsc -p web --noEmit
npx tsc -p web/viewer --noEmit
npx tsc -p tests/node --noEmit
node --test tests/node/*.test.mjs
node --test tests/browser/*.test.mjs
