#!/usr/bin/env bash
# Writes the golden streams again with the current encoder; tests/golden/README.md states when that
# is allowed.
set -euo pipefail
cd "$(dirname "$0")/.."

cmake --build --preset release --target write_golden
build/tests/golden/write_golden tests/golden
git --no-pager diff --stat -- tests/golden
