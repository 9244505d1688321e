#!/usr/bin/env bash
# Makes the Debian packages stackabilization (program, man page, completion), python3-stackabilization (the Python module)
# and libstackabilization-dev (libraries, headers, documentation) in build/release/packages, for the release of Debian or
# Ubuntu that it runs on. Installs what it needs first.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_packages.sh packages
scripts/build.sh stackabilize stackabilization_python
cpack --config build/release/CPackConfig.cmake
echo "To install them: apt install ./build/release/packages/*.deb"
