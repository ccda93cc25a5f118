#!/usr/bin/env bash
# Writes the golden streams anew with today's encoder; tests/golden/README.md says when that is allowed.
set -euo pipefail
cd "$(dirname "$0")/.."

cmake --build --preset release --target write_golden
build/tests/golden/write_golden tests/golden
git --no-pager diff --stat -- tests/golden
