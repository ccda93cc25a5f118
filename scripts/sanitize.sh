#!/usr/bin/env bash
# Runs C++ tests under sanitizers: `sanitize.sh [PRESET [SUITE...]]`. Presets: asan (GCC: addresses,
# leaks, undefined behaviour), ubsan-integer (Clang: undefined behaviour, and conversions that
# change a value), tsan (GCC: data races) and fuzz (as asan, in the fuzzers' build, which has the
# library already); by default asan, ubsan-integer and tsan. Suites: golden, hostile, unit, property,
# threads and, where address sanitizers are, native and command_line; by default all, golden and
# hostile with fuzz, and threads with tsan.
# SANITIZE_SECONDS, if set, ends a suite that takes longer. A finding ends its suite and is printed;
# exit status 1.
set -uo pipefail
cd "$(dirname "$0")/.."

presets=(asan ubsan-integer tsan)
if [ $# -gt 0 ]; then presets=("$1"); shift; fi
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
export UBSAN_OPTIONS=print_stacktrace=1 TSAN_OPTIONS=halt_on_error=1

suitesOf() {
  case $1 in
    fuzz) echo golden hostile ;;
    tsan) echo threads ;;
    asan) echo golden hostile unit property threads native command_line ;;
    *) echo golden hostile unit property ;;
  esac
}
# The folder of tests that a suite lies in.
folderOf() { if [ "$1" = command_line ]; then echo native; else echo "$1"; fi; }

failed=0
for preset in "${presets[@]}"; do
  suites=("$@")
  if [ ${#suites[@]} = 0 ]; then read -ra suites < <(suitesOf "$preset"); fi
  targets=("${suites[@]/%/_tests}")
  build=build/$preset
  mkdir -p "$build"
  log=$build/sanitize-build.log
  { cmake --preset "$preset" "${launcher[@]}" &&
    cmake --build "$build" --target "${targets[@]/#/isostar_}"; } >"$log" 2>&1 ||
    { tail -40 "$log" >&2; exit 1; }
  for suite in "${suites[@]}"; do
    log=$build/sanitize-$suite.log
    timeout "${SANITIZE_SECONDS:-0}" "$build/tests/$(folderOf "$suite")/isostar_${suite}_tests" \
      --gtest_brief=1 >"$log" 2>&1
    status=$?
    summary=$(grep -E '^\[==========\].*ran' "$log") ||
      summary=$([ $status = 124 ] && echo 'out of time' || echo "ended early, status $status")
    echo "sanitize: $preset $suite: $summary"
    [ $status = 0 ] && continue
    failed=1
    grep -E -A12 'ERROR: |WARNING: |runtime error|SUMMARY|Failure' "$log" | head -60 >&2
  done
done
exit $failed
