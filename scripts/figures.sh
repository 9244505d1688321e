#!/usr/bin/env bash
# Builds the program that makes the paper's figures and makes them all: pictures and numbers in paper_figures/pictures,
# the page about them in paper_figures/figures.md. With the authors' models (--paper-data FOLDER), which are not part of
# this project, everything goes to out/figures_authors instead, where it is not versioned.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

output=paper_figures/pictures page=paper_figures/figures.md arguments=()
if [[ ${1:-} == --paper-data && $# -eq 2 ]]; then
  output=out/figures_authors page=out/figures_authors/figures.md arguments=(--paper-data "$2")
elif [[ $# -ne 0 ]]; then
  echo "usage: scripts/figures.sh [--paper-data FOLDER]" >&2
  exit 2
fi

scripts/build.sh paper_figures
program=$(find build/release -name paper_figures -type f -perm -u+x | head -n 1)
"$program" --all -o "$output" --page "$page" "${arguments[@]}"
echo "The page about them: $page"
