#!/usr/bin/env bash
# Builds the fuzz targets with clang and runs each for SECONDS (default 60) in turn, or only the TARGETS named.
# Usage: scripts/fuzz.sh [SECONDS [TARGET...]]. Says what was found and where; status 1 when anything was.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

seconds=${1:-60}
shift || true
if ! [[ $seconds =~ ^[1-9][0-9]*$ ]]; then
  echo "scripts/fuzz.sh: expected a number of seconds, found '$seconds'" >&2
  exit 2
fi

source scripts/compiler_cache.sh
cmake --preset fuzz "${cache_options[@]}" >/dev/null
cmake --build --preset fuzz

programs=build/fuzz/tests/fuzz
work=build/fuzz/corpus  # grows from run to run
found=build/fuzz/found
mkdir -p "$found"
"$programs/make_fuzz_seeds" build/fuzz/seeds
targets=("$@")
(($# > 0)) || mapfile -t targets < <(ls build/fuzz/seeds)

export LSAN_OPTIONS=suppressions=$PWD/tests/support/leaks.txt:print_suppressions=0
status=0
for target in "${targets[@]}"; do
  mkdir -p "$work/$target"
  folders=("$work/$target" "build/fuzz/seeds/$target")
  [[ -d tests/fuzz/corpus/$target ]] && folders+=("tests/fuzz/corpus/$target")
  log=build/fuzz/$target.log
  if nice -n 10 "$programs/fuzz_$target" -max_total_time="$seconds" -rss_limit_mb=2500 -timeout=20 \
    -print_final_stats=1 -artifact_prefix="$found/$target-" "${folders[@]}" >"$log" 2>&1; then
    echo "$target: nothing found in $(awk '/number_of_executed_units/ {print $2}' "$log") runs"
  else
    echo "$target: FOUND $(sed -n 's/.*Test unit written to //p' "$log" | tail -1), see $log"
    status=1
  fi
done
((status == 0)) || echo "Mend it, and keep the input as tests/fuzz/corpus/TARGET/NAME, made small with -minimize_crash=1."
exit "$status"
