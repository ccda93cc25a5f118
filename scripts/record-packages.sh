#!/usr/bin/env bash
# Writes to build/packages.txt what the build is made of: the versions of tools, of the Debian
# packages that scripts/setup.sh installs, and of those whose libraries build/isostar loads.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

# Packages that are not installed are left out.
versionsOf() { dpkg-query -W -f '${Package} ${Version}\n' "$@" 2>/dev/null | sort -u; }

# The packages that own the libraries which a program loads.
ownersOf() {
  local library
  # dpkg knows a library by the name before or after the merge of /lib and /usr/lib.
  ldd "$1" | awk '$3 ~ /^\// { print $3 }' | while read -r library; do
    printf '%s\n' "${library#/usr}" "/usr${library#/usr}" "$(realpath "$library")"
  done | sort -u | xargs dpkg-query -S 2>/dev/null | sed 's/: .*//; s/,.*//' | sort -u || true
}

{
  echo "tools"
  echo "node $(node -p process.versions.node)"
  # npm prints its version in the name that it sends to registries.
  agent=${npm_config_user_agent:-}
  [ -z "$agent" ] || sed 's|^npm/\([^ ]*\).*|npm \1|' <<<"$agent"
  echo "g++ $(g++ -dumpfullversion)"
  echo "emcc $(tr -d '"' </usr/share/emscripten/emscripten-version.txt)"
  if command -v dpkg-query >/dev/null; then
    printf '\npackages of scripts/setup.sh\n'
    versionsOf "${buildPackages[@]}" "${testPackages[@]}" || true
    printf '\npackages that build/isostar loads\n'
    mapfile -t owners < <(ownersOf build/isostar)
    versionsOf "${owners[@]}"
  fi
} >build/packages.txt
