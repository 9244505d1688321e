#!/usr/bin/env bash
# Installs the packages it needs, builds everything and runs all tests; arguments go to ctest, for instance -L unit.
# Tests on outside data run when STACKABILIZATION_PAPER_DATA and STACKABILIZATION_CORPORA name their folders.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_packages.sh
# What the tests of the page need; they are skipped without.
if command -v npm >/dev/null; then
  npm ci --prefix tests/browser --no-audit --no-fund --loglevel=error
fi
scripts/build.sh
exec ctest --test-dir build/release --parallel "$(nproc)" --no-tests=error --output-on-failure "$@"
