#!/usr/bin/env bash
# What takes too long for every change: all tests, each fuzzer for SECONDS (by default 60), every
# suite under sanitizers, and the comparison of compilers: `nightly.sh [SECONDS]`. The others run
# even if one fails.
set -uo pipefail
cd "$(dirname "$0")/.."

failed=0
bash scripts/test.sh || failed=1
bash scripts/fuzz.sh "${1:-60}" || failed=1
bash scripts/sanitize.sh || failed=1
bash scripts/same-bytes.sh || failed=1
exit $failed
