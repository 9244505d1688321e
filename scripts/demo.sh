#!/usr/bin/env bash
# Builds the program, measures and validates a chair and a mug, finds their structure and makes an edit that keeps it,
# and leaves meshes, pictures and reports in out/demo.
# For a fresh Debian 12, Debian 13 or Ubuntu 24.04: installs the packages it needs first (asks for sudo if it must).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

echo "== 1/3 Packages"
scripts/install_packages.sh

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
echo "== 3/3 Two models: how high does each further copy sit, and do independent methods agree?"
for name in chair mug_with_handle; do
  model=data/models/$name.obj
  out=out/demo/$name
  show "${name}_inspect" inspect "$model" --unit m
  show "${name}_measure" measure "$model" --unit m --direction 0 0 1 --json "$out.json" --picture "$out.png"
  show "${name}_search" search "$model" --unit m --json "${out}_search.json"
  show "${name}_map" map "$model" --unit m --step-degrees 4 -o "${out}_map.csv" --picture "${out}_map.png"
  show "${name}_stack" stack "$model" --unit m -n 5 --direction 0 0 1 -o "${out}_stack.3mf" \
    --picture "${out}_stack.png" --json "${out}_stack.json"
  show "${name}_validate" validate "$model" --unit m --direction 0 0 1 --json "${out}_validate.json"
  show "${name}_structure" structure "$model" --unit m --picture "${out}_structure.png" --save "${out}.stackabilize.json" \
    --json "${out}_structure.json"
done

echo
echo "An edit of one handle each, with symmetries, joints and the height kept:"
show chair_edit deform out/demo/chair.stackabilize.json --edit "leg_front_left/section=0 move -0.03 -0.02 0" \
  --keep-extent 0 0 1 -o out/demo/chair_edit.obj --picture out/demo/chair_edit.png
show mug_with_handle_edit deform out/demo/mug_with_handle.stackabilize.json --edit "body/section=0 scale 0.8" \
  --keep-extent 0 0 1 -o out/demo/mug_with_handle_edit.obj --picture out/demo/mug_with_handle_edit.png

cat <<END

Done. In $PWD/out/demo, for chair and mug_with_handle (NAME):
  NAME.png           what touches what: envelopes seen from above (blue) and below (orange), contacts (red), the gap
  NAME_map.png       how well it stacks along every direction
  NAME_stack.png     five copies in place; NAME_stack.3mf the same for any 3D viewer
  NAME_structure.png parts, what stands for them, and where they are joined
  NAME_edit.png      before and after an edit; NAME_edit.obj the edited mesh
  NAME_*.txt         what you have just read; NAME*.json the same with every digit
How to read the numbers: docs/guide.md
END
