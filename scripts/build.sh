#!/usr/bin/env bash
# Configures the preset `release` and builds it, or only the targets given as arguments, into build/release.
# For the program and the Python module alone (build.sh stackabilize stackabilization_python) the packages of tests and
# experiments need not be there. A new build is made by clang where CC and CXX name no other compiler: it takes about
# half of the time of GCC, for a program of the same speed and the same results. A build that is there keeps its compiler.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# As many compilers as cores, but no more than memory holds: sources with CGAL's Nef polyhedra take up to 3 GB each.
available_gb=$(awk '/^MemAvailable/ {print int($2 / 1048576)}' /proc/meminfo)
jobs=$(nproc)
((jobs * 3 > available_gb)) && jobs=$((available_gb / 3))
((jobs < 1)) && jobs=1

with_tests=ON
[[ "$*" == stackabilize || "$*" == "stackabilize stackabilization_python" ]] && with_tests=OFF
options=(-DSTACKABILIZATION_BUILD_TESTS=$with_tests -DSTACKABILIZATION_BUILD_EXPERIMENTS=$with_tests)
source scripts/compiler_cache.sh
if [[ ! -e build/release/CMakeCache.txt && -z ${CC:-}${CXX:-} ]] && command -v clang++ >/dev/null; then
  options+=(-DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++)
fi
cmake --preset release "${options[@]}" "${cache_options[@]}"
targets=()
(($# > 0)) && targets=(--target "$@")
cmake --build --preset release --parallel "$jobs" "${targets[@]}"
