#!/usr/bin/env bash
# Runs every test: format, names, C++, types, Node, browser, fuzzers, sanitizers. Each runner prints
# its own summary; the others run even if one fails. `test.sh [SECONDS]`: how long each fuzzer runs,
# by default 10.
set -uo pipefail
cd "$(dirname "$0")/.."

failed=0
bash scripts/check-format.sh || failed=1
bash scripts/check-names.sh || failed=1
ctest --preset release -j2 || failed=1
for project in web web/viewer tests/node; do npx tsc -p "$project" --noEmit || failed=1; done
node --test tests/node/*.test.mjs || failed=1
# One browser at a time: two would slow each other down.
node --test --test-concurrency=1 --test-timeout=120000 tests/browser/*.test.mjs || failed=1
# Readers of other libraries are fuzzed by nightly.sh: their own faults come to light at any time.
own=(layers decode mended pieces round_trip ply obj stl glb raw named_files tiff_pages)
bash scripts/fuzz.sh "${1:-10}" "${own[@]}" || failed=1
bash scripts/sanitize.sh fuzz golden || failed=1
bash scripts/sanitize.sh tsan || failed=1
exit $failed
