#!/usr/bin/env bash
# Makes the figures of the paper from this project's models into out/figures, with a page about them all. Arguments go to
# the program: --paper-data FOLDER takes the authors' models instead. Installs the packages it needs first.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_packages.sh
scripts/build.sh paper_figures
status=0
build/release/paper_figures/paper_figures --all -o out/figures --page out/figures/figures.md "$@" || status=$?
echo "Pictures, numbers and the page figures.md are in $PWD/out/figures"
exit "$status"
