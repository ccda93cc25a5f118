#!/usr/bin/env bash
# Installs missing Debian packages (as root) and npm packages. `setup.sh test` adds those that only
# the tests need.
set -euo pipefail
cd "$(dirname "$0")/.."

source scripts/packages.sh
packages=("${buildPackages[@]}")
if [ "${1:-}" = test ]; then packages+=("${testPackages[@]}"); fi

isInstalled() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

missing=()
for package in "${packages[@]}"; do isInstalled "$package" || missing+=("$package"); done
if [ ${#missing[@]} -gt 0 ]; then
  if [ "$(id -u)" != 0 ]; then
    echo "setup: not root; run: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  echo "setup: installing ${missing[*]}"
  apt-get update -qq
  DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

# VTK reads tetrahedral meshes and images. Its -dev package depends on 770 MB that reading does not
# need: the libraries are installed (160 MB), and only the headers are unpacked beside the build.
hasVtkHeaders() { compgen -G 'build/vtk/usr/include/vtk-*' || compgen -G '/usr/include/vtk-*'; }
if ! hasVtkHeaders >/dev/null; then
  [ -n "$(apt-cache madison libvtk9-dev)" ] || apt-get update -qq
  library=$(apt-cache depends libvtk9-dev |
    sed -n 's/^ *Depends: \(libvtk9\.[0-9][0-9a-z]*\)$/\1/p')
  if ! isInstalled "$library"; then
    if [ "$(id -u)" != 0 ]; then
      echo "setup: not root; run: apt-get install --no-install-recommends $library" >&2
      exit 1
    fi
    echo "setup: installing $library"
    DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -qq --no-install-recommends "$library" >/dev/null
  fi
  mkdir -p build/vtk
  (
    cd build/vtk
    apt-get -o APT::Sandbox::User=root download -qq libvtk9-dev
    dpkg -x libvtk9-dev_*.deb .
    rm libvtk9-dev_*.deb
  )
fi

node -e '
  const [major, minor] = process.versions.node.split(".").map(Number);
  if (major < 20 || (major === 20 && minor < 19)) {
    console.error(`setup: Node ${process.versions.node} is too old; 20.19 or later is needed`);
    process.exit(1);
  }'
lock=$(sha256sum package-lock.json)
if [ "$(cat node_modules/.isostar-lock 2>/dev/null)" != "$lock" ]; then
  npm ci --no-audit --no-fund
  echo "$lock" > node_modules/.isostar-lock
fi
