#!/usr/bin/env bash
# Builds the program, makes a table and a mug stackable, and leaves a page with the solutions of each, meshes, pictures
# and reports in out/demo.
# For a fresh Debian 12, Debian 13 or Ubuntu 24.04: installs the packages it needs first (asks for sudo if it must).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

echo "== 1/3 Packages"
scripts/install_packages.sh program

echo
echo "== 2/3 Building (minutes the first time)"
mkdir -p out/demo
if ! scripts/build.sh stackabilize >out/demo/build.log 2>&1; then
  tail -n 30 out/demo/build.log >&2
  echo "The build failed; all of its output is in out/demo/build.log" >&2
  exit 1
fi
program=$(find build/release -name stackabilize -type f -perm -u+x | head -n 1)

# show NAME COMMAND ARGUMENTS...: runs the program, on the screen and into out/demo/NAME.txt.
show() {
  local report=out/demo/$1.txt
  shift
  echo
  echo "\$ stackabilize $*"
  "$program" "$@" | tee "$report"
}

echo
echo "== 3/3 A table and a mug that do not stack, and what becomes of them"
# make_stackable NAME TARGET
make_stackable() {
  local model=data/models/$1.obj out=out/demo/$1
  show "$1_measure" measure "$model" --unit m --direction 0 0 1 --json "${out}_measure.json" --picture "${out}_measure.png"
  show "$1_structure" structure "$model" --unit m --picture "${out}_structure.png" --save "$out.stackabilize.json"
  show "$1_improve" improve "$out.stackabilize.json" --direction 0 0 1 --target "$2" -o "$out" ||
    [[ $? -eq 1 ]]  # not reached: the page then says how near it came
  if [[ -e $out/solution_1.obj ]]; then
    show "$1_validate" validate "$out/solution_1.obj" --unit m --direction 0 0 1
  fi
}
make_stackable table 0.45
make_stackable mug_with_handle 0.5

cat <<END

Done. Open these pages in a browser: the solutions side by side, before and after, with their stacks:
  $PWD/out/demo/table/index.html
  $PWD/out/demo/mug_with_handle/index.html
Beside them in $PWD/out/demo, for table and mug_with_handle (NAME):
  NAME/solution_1.obj  the best solution; .3mf the same for any 3D viewer; .json every number and check
  NAME_measure.png     what touches what: envelopes seen from above (blue) and below (orange), contacts (red), the gap
  NAME_structure.png   parts, what stands for them, and where they are joined
  NAME_*.txt           what you have just read
How to read the numbers: docs/guide.md
END
