#!/usr/bin/env bash
# Formats all sources with clang-format; with --check only says which files it would change, and fails if there are any.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

formatter=$(command -v clang-format-14 || command -v clang-format) || {
  echo "clang-format is not installed." >&2
  exit 1
}
mode=(-i)
[[ ${1:-} == --check ]] && mode=(--dry-run --Werror)
git ls-files -z '*.h' '*.cpp' | xargs -0 "$formatter" "${mode[@]}"
