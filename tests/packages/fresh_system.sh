#!/usr/bin/env bash
# fresh_system.sh BUILD_FOLDER SOURCE_FOLDER: makes the packages, installs them into a fresh Debian in a folder, and runs
# the commands of the demo and the examples of the README there. Prints SKIPPED: and the reason where that is impossible.
set -euo pipefail
build=$1 source=$2

skip() {
  echo "SKIPPED: $1"
  exit 0
}
# shellcheck source=/dev/null
. /etc/os-release
[[ ${ID:-} == debian ]] || skip "the packages are for the release of Debian that they are built on"
[[ $(id -u) -eq 0 ]] || skip "a fresh system needs root"
command -v debootstrap >/dev/null || skip "debootstrap is not installed"

cpack --config "$build/CPackConfig.cmake" >/dev/null
mirror=$(apt-get indextargets --format '$(REPO_URI)' "Codename: $VERSION_CODENAME" "Origin: Debian" "Component: main" | head -n 1)
[[ -n $mirror ]] || skip "no mirror of $VERSION_CODENAME among the sources of apt"
root=$(mktemp -d)
trap 'rm -rf --one-file-system "$root"' EXIT
debootstrap --variant=minbase "$VERSION_CODENAME" "$root" "$mirror" >"$build/debootstrap.log" 2>&1 ||
  skip "no fresh system, see $build/debootstrap.log"
# Packages come from where this machine has them from.
cp -rT /etc/apt "$root/etc/apt"
cp /etc/resolv.conf "$root/etc/resolv.conf"
mkdir "$root/packages"
cp "$build"/packages/*.deb "$source"/data/models/*.obj "$root/packages"

in_root() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/ DEBIAN_FRONTEND=noninteractive bash -euxc "$1"
}
in_root "apt-get -q update && cd /packages && apt-get -q install -y --no-install-recommends ./*.deb"
in_root "cd /packages
  stackabilize --version | grep '^stackabilize [0-9]'
  stackabilize measure table.obj --unit m --direction 0 0 1 --picture measured.png
  stackabilize improve table.obj --unit m --direction 0 0 1 --target 0.45 --effort 0.3 -o table
  stackabilize validate table/solution_1.obj --unit m --direction 0 0 1
  test -s table/index.html -a -s measured.png
  bash -c 'source /usr/share/bash-completion/completions/stackabilize; complete -p stackabilize'"
in_root "cd /packages
  python3 -c 'import stackabilization as st; print(st.measure(\"chair.obj\")); print(st.stack(\"crate.obj\", n=10))'"
in_root "cd /packages
  apt-get -q install -y --no-install-recommends cmake g++ make pkg-config
  cp -r /usr/share/doc/Stackabilization/examples project && cmake -S project -B built && cmake --build built --target measure
  built/measure cup.obj"
echo "The packages work on a fresh $PRETTY_NAME."
