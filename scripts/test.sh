#!/usr/bin/env bash
# Every test: C++, types, Node, browser. Each runner ends with its own summary; one that fails does not keep the others from running.
set -uo pipefail
cd "$(dirname "$0")/.."

failed=0
ctest --preset release -j2 || failed=1
for project in web web/viewer tests/node; do npx tsc -p "$project" --noEmit || failed=1; done
node --test tests/node/*.test.mjs || failed=1
# Two browsers at once would slow each other.
node --test --test-concurrency=1 --test-timeout=120000 tests/browser/*.test.mjs || failed=1
exit $failed
