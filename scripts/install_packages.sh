#!/usr/bin/env bash
# Installs packages on Debian 12, Debian 13 and Ubuntu 24.04: install_packages.sh [program | packages | all].
# program: what the program needs to be built and run. packages: also what the Python module and Debian packages need.
# all (default): also what tests, experiments and the reference need.
# Does nothing, and needs no rights, when everything is there already.
set -euo pipefail

purpose=${1:-all}
packages=(
  g++ clang cmake ninja-build ccache pkg-config git
  libcgal-dev libeigen3-dev libboost-dev libtbb-dev libgmp-dev libmpfr-dev
  libpugixml-dev libminizip-dev zlib1g-dev libtinygltf-dev nlohmann-json3-dev libcli11-dev
  libvtk9-dev libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri
)
for_packages=(pybind11-dev python3-dev python3-numpy dpkg-dev file)
case $purpose in
  program) ;;
  packages) packages+=("${for_packages[@]}") ;;
  all)
    packages+=("${for_packages[@]}" catch2 libopenmesh-dev libembree-dev libfcl-dev doxygen python3
      python3-pytest python3-hypothesis python3-nbclient python3-ipykernel python3-matplotlib mypy)
    # For the tests of the page of `edit`. Ubuntu has no package of Chromium but a snap; there they are skipped.
    command -v npm >/dev/null || packages+=(nodejs npm)
    # debootstrap: for the packages for Debian, which are installed into a fresh system.
    grep -qx 'ID=debian' /etc/os-release && packages+=(chromium debootstrap)
    ;;
  *)
    echo "scripts/install_packages.sh: expected 'program', 'packages' or 'all', found '$purpose'" >&2
    exit 2
    ;;
esac

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
