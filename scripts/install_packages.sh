#!/usr/bin/env bash
# Installs what the build, the tests and the demo need on Debian 12, Debian 13 and Ubuntu 24.04.
# Does nothing, and needs no rights, when everything is there already.
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache pkg-config git
  libcgal-dev libeigen3-dev libboost-dev libopenmesh-dev libtbb-dev libgmp-dev libmpfr-dev
  libpugixml-dev libminizip-dev libtinygltf-dev nlohmann-json3-dev libcli11-dev
  libvtk9-dev libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri
  libembree-dev libfcl-dev
  catch2 doxygen python3
)

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "This script knows Debian and Ubuntu only. Elsewhere, install what these packages hold: ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null || true)
  [[ $status == *installed* && $status != *not-installed* ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  echo "All packages are installed."
  exit 0
fi

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "Missing packages: ${missing[*]}" >&2
    echo "Run this script as root, or install them as root: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 "$@"
}
echo "Installing: ${missing[*]}"
apt update
apt install -y --no-install-recommends "${missing[@]}"
