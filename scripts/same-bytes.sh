#!/usr/bin/env bash
# Do all builds make the same bytes and the same meshes? `same-bytes.sh [--quick] [--data FOLDER]`
# builds the codec with several compilers and options, encodes the golden sources (and the volumes
# of FOLDER) with each, decodes every stream layer by layer, and compares bytes, positions, normals
# and indices, bit by bit, with the first build's. WebAssembly decodes the first build's streams;
# it needs web/dist (npm run build). --quick: two builds, without WebAssembly. Exit status 1 if
# anything differs.
set -uo pipefail
cd "$(dirname "$0")/.."

usage='usage: same-bytes.sh [--quick] [--data FOLDER]'
quick='' data=''
while [ $# -gt 0 ]; do
  case $1 in
    --quick) quick=1 ;;
    --data) data=${2:?$usage}; shift ;;
    *) echo "$usage" >&2; exit 2 ;;
  esac
  shift
done

# Name, compiler, -march= of the codec, options.
builds=('g++-O3 g++ x86-64-v2 -O3' 'clang++-O0 clang++ x86-64-v2 -O0')
if [ -z "$quick" ]; then
  builds+=(
    'g++-O0 g++ x86-64-v2 -O0'
    'g++-O3-native g++ native -O3 -march=native'
    'clang++-O3 clang++ x86-64-v2 -O3'
    'clang++-O3-native clang++ native -O3 -march=native'
  )
fi
# Another standard library may sort and hash otherwise.
if [ -z "$quick" ] && compgen -G '/usr/lib/llvm-*/include/c++/v1/vector' >/dev/null; then
  builds+=('clang++-libc++ clang++ x86-64-v2 -O2 -stdlib=libc++')
fi
root=build/same
mkdir -p $root
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
list=()
if [ -n "$data" ]; then
  node tests/builds/volume-list.mjs "$data" $root/volumes || exit 1
  list=($root/volumes/volumes.txt)
fi

# Configures and builds the codec: FOLDER, COMPILER, -march=, OPTIONS.
build() {
  cmake -S . -B "$1" -G Ninja "${launcher[@]}" -DISOSTAR_CODEC_ONLY=ON -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_COMPILER="$2" -DISOSTAR_ARCHITECTURE="$3" -DCMAKE_CXX_FLAGS="$4" &&
    cmake --build "$1" -j "$(nproc)"
}

# Writes the streams and surfaces.txt of a build.
run() {
  local folder=$root/$1
  rm -rf "$folder/streams" && mkdir -p "$folder/streams"
  build "$folder" "${@:2}" >"$folder/build.log" 2>&1 || { cat "$folder/build.log" >&2; return 1; }
  "$folder/tests/builds/print_surfaces" "$folder/streams" "${list[@]}" >"$folder/surfaces.txt"
}

failed=0
# Prints a row: how many streams and meshes are those of the first build.
compare() {
  local name=$1 streams=$2 meshes=$3 equalStreams=- equalMeshes
  if [ "$streams" != - ]; then
    equalStreams=0
    for stream in "$first"/streams/*; do
      cmp -s "$stream" "$root/$name/streams/${stream##*/}" && equalStreams=$((equalStreams + 1))
    done
  fi
  equalMeshes=$(grep '^mesh' "$root/$name/surfaces.txt" | grep -Fxc -f "$first/surfaces.txt")
  printf '%-20s %10s %14s\n' "$name" "$equalStreams/$streams" "$equalMeshes/$meshes"
  [ "$equalStreams/$equalMeshes" = "$streams/$meshes" ] && return
  failed=1
  grep '^mesh' "$root/$name/surfaces.txt" | grep -vFx -f "$first/surfaces.txt" | head -5 >&2
}

first=$root/${builds[0]%% *}
for build in "${builds[@]}"; do
  read -r name compiler march options <<<"$build"
  run "$name" "$compiler" "$march" "$options" || exit 1
done
echo 'SHA-256 of streams and meshes:'
for stream in "$first"/streams/*; do
  kind=$(basename "$stream" .isostar)
  sums=("$(sha256sum <"$stream")" "$(grep "^mesh $kind " "$first/surfaces.txt" | sha256sum)")
  printf '%-20s %.16s %.16s\n' "$kind" "${sums[@]}"
done
printf '\n%-20s %10s %14s\n' build streams meshes
streams=$(grep -c '^stream' "$first/surfaces.txt")
meshes=$(grep -c '^mesh' "$first/surfaces.txt")
for build in "${builds[@]}"; do compare "${build%% *}" "$streams" "$meshes"; done
if [ -z "$quick" ]; then
  mkdir -p $root/WebAssembly
  node tests/builds/print-surfaces.mjs "$first/streams" >$root/WebAssembly/surfaces.txt || exit 1
  # Not those of images and sequences.
  volumes=$(grep -c '^mesh' $root/WebAssembly/surfaces.txt)
  compare WebAssembly - "$volumes"
fi
exit $failed
