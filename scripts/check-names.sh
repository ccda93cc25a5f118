#!/usr/bin/env bash
# Checks the names of types, functions and variables in C++ against .clang-tidy. Needs a configured
# build (compile_commands.json).
set -uo pipefail
cd "$(dirname "$0")/.."

if ! command -v clang-tidy >/dev/null; then
  echo 'check-names: clang-tidy is not installed; names are not checked' >&2
  exit 0
fi
found=$(git ls-files -z 'shared/*.cpp' native/{cli,files,measure,mesh_io,model}/'*.cpp' |
  xargs -0 -P "$(nproc)" -n 4 clang-tidy -p build --quiet \
    -checks='-*,readability-identifier-naming' -header-filter='/(shared|native)/' 2>/dev/null |
  grep -E "^$PWD/.*warning: " | sed "s|^$PWD/||" | sort -u)
[ -z "$found" ] && exit 0
echo "$found" >&2
exit 1
