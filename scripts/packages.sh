# shellcheck shell=bash
# The Debian packages that the build needs, and those that only the tests need; other scripts
# source this file.
# shellcheck disable=SC2034 # used by others
buildPackages=(
  g++ cmake ninja-build ccache emscripten                 # compilers
  libcli11-dev nlohmann-json3-dev                         # the command line
  libinsighttoolkit5-dev libnifti2-dev                    # volumes
  libgtest-dev libglm-dev                                 # tests, built with everything else
  libdraco-dev draco libmeshoptimizer-dev libzstd-dev     # the codecs of the comparison
)
testPackages=(
  chromium clang-format clang-tidy
  clang libclang-rt-dev                                   # fuzzers and sanitizers
)
