#!/usr/bin/env bash
# Configures the preset `release` and builds it, or only the targets given as arguments, into build/release.
# For the program and the Python module alone (build.sh stackabilize stackabilization_python) the packages of tests and
# experiments need not be there.
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
cmake --preset release "${options[@]}" "${cache_options[@]}"
targets=()
(($# > 0)) && targets=(--target "$@")
cmake --build --preset release --parallel "$jobs" "${targets[@]}"
