#!/usr/bin/env bash
# Runs every test: format, names, C++, types, Node, browser, fuzzers, sanitizers. Each runner prints
# its own summary; the others run even if one fails. `test.sh [SECONDS]`: how long each fuzzer runs,
# by default 10.
set -uo pipefail
cd "$(dirname "$0")/.."

failed=()
# Runs a command, and remembers it if it fails.
run() { "$@" || failed+=("$*"); }

run bash scripts/check-format.sh
run bash scripts/check-names.sh
run ctest --preset release -j2
for project in web web/viewer tests/node; do run npx tsc -p "$project" --noEmit; done
run node --test tests/node/*.test.mjs
# One browser at a time: two would slow each other down.
run node --test --test-concurrency=1 --test-timeout=120000 tests/browser/*.test.mjs
# Readers of other libraries are fuzzed by nightly.sh: their own faults come to light at any time.
own=(layers decode mended pieces round_trip ply obj stl glb raw named_files tiff_pages)
run bash scripts/fuzz.sh "${1:-10}" "${own[@]}"
run bash scripts/sanitize.sh fuzz golden
run bash scripts/sanitize.sh tsan
[ ${#failed[@]} = 0 ] && exit 0
printf 'failed: %s\n' "${failed[@]}" >&2
exit 1
