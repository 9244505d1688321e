#!/usr/bin/env bash
# Builds the program and its tests with clang's thread sanitizer and runs the tests that use threads, one at a time.
# Usage: scripts/thread_sanitizer.sh ONETBB_SOURCE [CTEST_ARGUMENT...]
# ONETBB_SOURCE is a folder with the sources of oneTBB, for instance of `apt-get source onetbb`. The library of the
# system is not built with the sanitizer, which then takes what its scheduler hands from thread to thread for races.
set -euo pipefail
source=${1:+$(realpath -m -- "$1")}
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [[ ! -f $source/CMakeLists.txt || ! -f $source/include/oneapi/tbb/version.h ]]; then
  echo "scripts/thread_sanitizer.sh: expected a folder with the sources of oneTBB, found '$source'" >&2
  exit 2
fi
shift

options=(-DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++)
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
fi
tbb=$PWD/build/thread_tbb
cmake -S "$source" -B "$tbb/build" -G Ninja "${options[@]}" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_CXX_FLAGS=-fsanitize=thread -DCMAKE_INSTALL_PREFIX="$tbb" -DCMAKE_INSTALL_LIBDIR=lib \
  -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF >/dev/null
cmake --build "$tbb/build" --target install >/dev/null
cmake --preset thread "${options[@]}" -DTBB_DIR="$tbb/lib/cmake/TBB" >/dev/null
cmake --build --preset thread

# The sanitizer of clang 14 needs addresses where they are without randomisation.
exec setarch -R ctest --preset thread "$@"
