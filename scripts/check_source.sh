#!/usr/bin/env bash
# House rules that a compiler does not check. Prints each line that breaks one and exits with 1 if there is any.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

broken=0

# report WHAT LINES: LINES are "file:line:text", empty when the rule holds.
report() {
  [[ -z $2 ]] && return
  printf '%s:\n%s\n' "$1" "$2"
  broken=1
}

# source_lines PATTERN GREP_OPTIONS...: lines of src/ and include/ that match outside // comments.
source_lines() {
  local pattern=$1
  shift
  grep -rnE "$@" -- "$pattern" src include | grep -vE "^[^:]+:[0-9]+:[[:space:]]*//" |
    grep -E "^[^:]+:[0-9]+:([^/]|/[^/])*($pattern)" || true
}

# shear.h names the rounding unit that the exact filters count in.
report "Epsilon outside the tolerances.h of a module" \
  "$(source_lines '[0-9.][eE]-[0-9]|0x[0-9a-fA-F.]+p-|epsilon\(\)' --include=*.h --include=*.cpp \
    --exclude=tolerances.h --exclude=shear.h)"
# Pictures are full of small sizes; elsewhere a constant or an option says what such a number means.
report "Small decimal without a name" \
  "$(source_lines '[^0-9A-Za-z_.]0?\.0[0-9]*[1-9]' --include=*.h --include=*.cpp --exclude-dir=rendering \
    --exclude=tolerances.h | grep -vE ':( *constexpr)? *double [a-z_]+ = 0\.0[0-9]+;|return 0\.0[0-9]+;' || true)"
report "Public header that shows a third-party library other than Eigen" \
  "$(grep -rnE '#include [<"](CGAL|OpenMesh|boost|vtk|tbb|gmp|mpfr|pugixml|minizip|unzip|zip\.h|tiny_gltf|nlohmann|GL/|EGL/)' \
    include || true)"
report "Public header that includes a private one" \
  "$(grep -rnE '#include "' include | grep -v '#include "stackabilization/' || true)"
report "Output from the library" \
  "$(source_lines '(std::(cout|cerr|clog)|[^a-z_]f?printf *\(|[^a-z_]puts *\()' --include=*.h --include=*.cpp)"
# docs/glossary.md has the words that took their place.
report "Word that is not used any more" \
  "$(grep -rnE '\b(least|most|fewest)_[a-z]|[Ii]dealis|[Cc]rumb|Not installed\.' --include=*.h --include=*.cpp \
    src include apps || true)"
# To the linker they are one class, whose functions it takes from either.
report "Class with the name of another one in its namespace" \
  "$(find src include apps -name '*.h' | sort | xargs awk '
    /^namespace [a-z_:]+ \{/ { space = $2 }
    /^(class|struct) [A-Za-z0-9_]+( final)?( :.*)? *\{/ {
      name = space "::" $2
      if (name in seen && seen[name] != FILENAME) print FILENAME ":" FNR ": " name " is in " seen[name] ", too"
      seen[name] = FILENAME
    }')"
report "Header without include guard" "$(grep -rLx '#pragma once' --include=*.h src include || true)"

# A module may include only these modules: itself and those that it is built on.
declare -A modules=(
  [core]='core'
  [mesh]='core mesh'
  [io]='core mesh io'
  [numerics]='core numerics'
  [envelope]='core mesh envelope'
  [stacking]='core mesh numerics envelope stacking'
  [structure]='core mesh io structure'
  [deformation]='core mesh io numerics structure deformation'
  [improvement]='core mesh io numerics envelope stacking structure deformation improvement'
  [editing]='core mesh io numerics envelope stacking structure deformation improvement editing'
  [rendering]='core mesh io envelope stacking structure deformation improvement rendering'
)
# A part of a module may include only itself and the parts before it. A public header belongs to the part that holds
# the source of its name.
declare -A parts=(
  [core]=''
  [mesh]=''
  [io]='files formats'
  [numerics]=''
  [envelope]='separation height_bounds height_field contacts'
  [stacking]='measure direction stacks place validation draft statics'
  [structure]='model fitting symmetry joints segmentation analysis project'
  [deformation]='model controllers carried arap iwires gap_scaling factory'
  [improvement]='design quality requirements history contacts explanation search advice refinement run'
  [editing]='document structure session study'
  [rendering]='gl drawing scene pictures'
)
for folder in src/*/ include/stackabilization/*/; do
  module=$(basename "$folder")
  if [[ -z ${modules[$module]:-} ]]; then
    report "Module without a rule in scripts/check_source.sh" "$folder"
    continue
  fi
  report "Module $module reaches back" \
    "$(grep -rnE '#include "' "$folder" |
      grep -vE "#include \"(stackabilization/)?(${modules[$module]// /|})/" || true)"
done
for module in "${!parts[@]}"; do
  before=''
  for part in ${parts[$module]}; do
    before+="${before:+|}$part"
    report "Part $part of $module reaches back" "$(
      grep -rnE "#include \"$module/[a-z_]+/" "src/$module/$part" | grep -vE "#include \"$module/($before)/" || true
      grep -rnE "#include \"stackabilization/$module/" "src/$module/$part" | while IFS= read -r line; do
        header=${line##*/}
        owner=$(find "src/$module" -name "${header%%.*}.cpp" -printf '%h\n' -quit)
        [[ -z $owner || "|$before|" == *"|$(basename "$owner")|"* ]] || echo "$line"
      done
    )"
  done
  for folder in "src/$module"/*/; do
    [[ -d $folder && " ${parts[$module]} " != *" $(basename "$folder") "* ]] &&
      report "Part without a rule in scripts/check_source.sh" "$folder"
  done
done

# The folders of the program: each may include only those before it.
before=''
for folder in common measure stack structure deform suggest report improve editor; do
  before+="${before:+|}$folder"
  report "Folder $folder of apps reaches back" \
    "$(grep -rnE '#include "apps/' "apps/$folder" --include=*.h --include=*.cpp | grep -vE "#include \"apps/($before)/" || true)"
done

# Absolute paths of somebody's machine, in everything that is versioned.
report "Absolute path" "$(git grep -nIE "(^|[^A-Za-z0-9_.\$}])/(home|root|work|tmp|mnt|Users)/" -- . \
  ':!scripts/check_source.sh' 2>/dev/null || true)"

exit "$broken"
