#!/usr/bin/env bash
# Builds the program and its tests with clang's thread sanitizer and runs the tests that use threads, one at a time.
# Usage: scripts/thread_sanitizer.sh ONETBB_SOURCE [CTEST_ARGUMENT...]
# ONETBB_SOURCE is a folder with the sources of oneTBB, for instance of `apt-get source onetbb`. The library of the
# system is not built with the sanitizer, which then takes what its scheduler hands from thread to thread for races.
set -euo pipefail
tbb_source=${1:+$(realpath -m -- "$1")}
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [[ ! -f $tbb_source/CMakeLists.txt || ! -f $tbb_source/include/oneapi/tbb/version.h ]]; then
  echo "scripts/thread_sanitizer.sh: expected a folder with the sources of oneTBB, found '$tbb_source'" >&2
  exit 2
fi
shift

source scripts/compiler_cache.sh
tbb=$PWD/build/thread_tbb
cmake -S "$tbb_source" -B "$tbb/build" -G Ninja "${cache_options[@]}" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang \
  -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_CXX_FLAGS=-fsanitize=thread -DCMAKE_INSTALL_PREFIX="$tbb" -DCMAKE_INSTALL_LIBDIR=lib \
  -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF >/dev/null
cmake --build "$tbb/build" --target install >/dev/null
cmake --preset thread "${cache_options[@]}" -DTBB_DIR="$tbb/lib/cmake/TBB" >/dev/null
cmake --build --preset thread

# The sanitizer of clang 14 needs addresses where they are without randomisation.
exec setarch -R ctest --preset thread "$@"
