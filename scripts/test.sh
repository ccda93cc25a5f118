#!/usr/bin/env bash
# Every test: C++, Node, browser. Each runner ends with its own summary.
set -euo pipefail
cd "$(dirname "$0")/.."

ctest --preset release -j2
npx tsc -p web --noEmit
npx tsc -p web/viewer --noEmit
npx tsc -p tests/node --noEmit
node --test tests/node/*.test.mjs
node --test --test-concurrency=1 --test-timeout=120000 tests/browser/*.test.mjs  # two browsers at once would slow each other
