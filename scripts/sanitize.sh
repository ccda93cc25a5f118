#!/usr/bin/env bash
# Runs C++ tests under sanitizers: `sanitize.sh [PRESET [SUITE...]]`. Presets: asan (GCC: addresses,
# leaks, undefined behaviour) and ubsan-integer (Clang: undefined behaviour, and conversions that
# change a value); by default both. Suites: golden, hostile, unit, property and, with asan, native;
# by default all but property. A finding ends its suite and is printed; exit status 1.
set -uo pipefail
cd "$(dirname "$0")/.."

presets=(asan ubsan-integer)
if [ $# -gt 0 ]; then presets=("$1"); shift; fi
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
export UBSAN_OPTIONS=print_stacktrace=1

failed=0
for preset in "${presets[@]}"; do
  suites=("$@")
  if [ ${#suites[@]} = 0 ]; then
    suites=(golden hostile unit)
    if [ "$preset" = asan ]; then suites+=(native); fi
  fi
  targets=("${suites[@]/%/_tests}")
  mkdir -p build
  log=build/$preset.log
  { cmake --preset "$preset" "${launcher[@]}" &&
    cmake --build "build/$preset" --target "${targets[@]/#/isostar_}"; } >"$log" 2>&1 ||
    { cat "$log" >&2; exit 1; }
  for suite in "${suites[@]}"; do
    "build/$preset/tests/$suite/isostar_${suite}_tests" --gtest_brief=1 >"$log" 2>&1
    status=$?
    echo "sanitize: $preset $suite: $(grep -E '^\[==========\].*ran' "$log" || echo 'ended early')"
    [ $status = 0 ] && continue
    failed=1
    grep -E -A12 'ERROR: |runtime error|SUMMARY|Failure' "$log" | head -60 >&2
  done
done
exit $failed
