#!/usr/bin/env bash
# Fuzzes: `fuzz.sh SECONDS [TARGET...]` builds targets of tests/fuzz with clang, by default all, runs
# the known inputs of tests/fuzz/regressions and then each target for SECONDS, one target a core, and
# prints executions, coverage and findings. Exit status 1 if there are findings: they are in build/fuzz/findings.
# Corpora grow in build/fuzz/corpus. The target `children` mutates files for readers that run in a
# child process, with build/isostar.
set -uo pipefail
cd "$(dirname "$0")/.."

usage='usage: fuzz.sh SECONDS [TARGET...]'
[[ "${1:-}" =~ ^[1-9][0-9]*$ ]] || { echo "$usage" >&2; exit 2; }
seconds=$1
shift

command -v clang++ >/dev/null || { echo 'fuzz: clang is not installed' >&2; exit 1; }
build=build/fuzz
programs=$build/tests/fuzz
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
mkdir -p $build
targets=(isostar_fuzz)
if [ $# -gt 0 ]; then targets=(write_seeds); fi
for name in "$@"; do
  if [ "$name" != children ]; then targets+=("${name}_fuzz"); fi
done
{ cmake --preset fuzz "${launcher[@]}" &&
  cmake --build --preset fuzz -j "$(nproc)" --target "${targets[@]}"; } \
  >$build/fuzz-build.log 2>&1 || { cat $build/fuzz-build.log >&2; exit 1; }
$programs/write_seeds $programs/seeds || exit 1

# Runs the known inputs of a target with its options.
runKnown() {
  local name=$1 known failed=0
  shift
  for known in tests/fuzz/regressions/"$name"-*; do
    [ -e "$known" ] || continue
    "$programs/${name}_fuzz" "$@" "$known" >"$build/$name.log" 2>&1 && continue
    echo "fuzz: $known fails again" >&2
    failed=1
  done
  return $failed
}

# Runs a target and prints its row.
runTarget() {
  local name=$1 findings=$build/findings/$1 log=$build/$1.log failed=0 before corpus options
  local executions edges='' features=''
  mkdir -p "$findings" "$build/corpus/$name"
  before=$(find "$findings" -type f | wc -l)
  if [ "$name" = children ]; then
    node tests/fuzz/children.mjs "$seconds" build/isostar $programs/seeds "$findings" \
      >"$log" 2>&1 || failed=1
    executions=$(sed -n 's/^executions: //p' "$log")
  else
    # A line of targets.txt: name, corpus, libFuzzer's options.
    read -r _ corpus options < <(grep "^$name " $programs/targets.txt) ||
      { echo "fuzz: no target $name" >&2; return 1; }
    # shellcheck disable=SC2086 # words
    runKnown "$name" $options || failed=1
    # shellcheck disable=SC2086 # words
    "$programs/${name}_fuzz" -max_total_time="$seconds" -print_final_stats=1 $options \
      -artifact_prefix="$findings/" "$build/corpus/$name" "$programs/seeds/$corpus" \
      >"$log" 2>&1 || failed=1
    executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -1)
    edges=$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' "$log" | tail -1)
    features=$(sed -n 's/.* ft: \([0-9]*\).*/\1/p' "$log" | tail -1)
  fi
  printRow "$name" "${executions:--}" "${edges:--}" "${features:--}" \
    $(($(find "$findings" -type f | wc -l) - before))
  [ $failed = 0 ] || grep -E 'ERROR|runtime error|SUMMARY|finding' "$log" | head -5 >&2
  return $failed
}
printRow() { printf '%-12s %12s %8s %9s %9s\n' "$@"; }

names=("$@")
if [ ${#names[@]} = 0 ]; then
  mapfile -t names < <(cut -d' ' -f1 $programs/targets.txt; echo children)
fi
printRow target executions edges features findings
export build programs seconds
export -f runKnown runTarget printRow
printf '%s\n' "${names[@]}" | xargs -P "$(nproc)" -I{} bash -c 'runTarget {}' || exit 1
