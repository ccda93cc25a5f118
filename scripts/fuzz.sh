#!/usr/bin/env bash
# Fuzzes: `fuzz.sh SECONDS [TARGET...]` builds tests/fuzz with clang, runs the known inputs of
# tests/fuzz/regressions and then each target for SECONDS, and prints executions, coverage and
# findings. Exit status 1 if there are findings: they are in build/fuzz/findings. Corpora grow in
# build/fuzz/corpus. The target `children` mutates files for readers that run in a child process,
# with build/isostar.
set -uo pipefail
cd "$(dirname "$0")/.."

usage='usage: fuzz.sh SECONDS [TARGET...]'
[[ "${1:-}" =~ ^[0-9]+$ ]] || { echo "$usage" >&2; exit 2; }
seconds=$1
shift

command -v clang++ >/dev/null || { echo 'fuzz: clang is not installed' >&2; exit 1; }
build=build/fuzz
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
mkdir -p $build
for step in "--preset fuzz ${launcher[*]}" '--build --preset fuzz'; do
  # shellcheck disable=SC2086 # words
  cmake $step >$build/fuzz-build.log 2>&1 || { cat $build/fuzz-build.log >&2; exit 1; }
done
seeds=$build/tests/fuzz/seeds
$build/tests/fuzz/write_seeds $seeds || exit 1

# Name, corpus and libFuzzer's options of each target.
targets=$build/tests/fuzz/targets.txt
names=("$@")
if [ ${#names[@]} = 0 ]; then mapfile -t names < <(cut -d' ' -f1 $targets; echo children); fi

failed=0
row='%-12s %12s %8s %9s %9s\n'
# shellcheck disable=SC2059 # the format of a row
printf "$row" target executions edges features findings
for name in "${names[@]}"; do
  findings=$build/findings/$name
  mkdir -p "$findings"
  before=$(find "$findings" -type f | wc -l)
  log=$build/$name.log
  executions='' edges='' features=''
  if [ "$name" = children ]; then
    [ -x build/isostar ] || { echo 'fuzz: children need build/isostar' >&2; failed=1; continue; }
    node tests/fuzz/children.mjs "$seconds" build/isostar $seeds "$findings" >"$log" 2>&1
    status=$?
    executions=$(sed -n 's/^executions: //p' "$log")
  else
    read -r _ corpus options < <(grep "^$name " $targets) ||
      { echo "fuzz: no target $name" >&2; exit 2; }
    mkdir -p "$build/corpus/$name"
    for known in tests/fuzz/regressions/"$name"-*; do
      [ -e "$known" ] || continue
      # shellcheck disable=SC2086 # words
      "$build/tests/fuzz/${name}_fuzz" $options "$known" >"$log" 2>&1 && continue
      echo "fuzz: $known fails again" >&2
      failed=1
    done
    # shellcheck disable=SC2086 # words
    "$build/tests/fuzz/${name}_fuzz" -max_total_time="$seconds" -print_final_stats=1 $options \
      -artifact_prefix="$findings/" "$build/corpus/$name" "$seeds/$corpus" >"$log" 2>&1
    status=$?
    executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -1)
    edges=$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' "$log" | tail -1)
    features=$(sed -n 's/.* ft: \([0-9]*\).*/\1/p' "$log" | tail -1)
  fi
  found=$(($(find "$findings" -type f | wc -l) - before))
  # shellcheck disable=SC2059 # the format of a row
  printf "$row" "$name" "${executions:--}" "${edges:--}" "${features:--}" "$found"
  if [ $status != 0 ]; then
    failed=1
    grep -E 'ERROR|runtime error|SUMMARY|finding' "$log" | head -5 >&2
  fi
done
exit $failed
