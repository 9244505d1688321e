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

# source_lines PATTERN GREP_OPTIONS...: lines of src/ that match outside // comments.
source_lines() {
  local pattern=$1
  shift
  grep -rnE "$@" -- "$pattern" src | grep -vE "^[^:]+:[0-9]+:[[:space:]]*//" |
    grep -E "^[^:]+:[0-9]+:([^/]|/[^/])*($pattern)" || true
}

# shear.h names the rounding unit that the exact filters count in.
report "Epsilon outside shape/tolerances.h" \
  "$(source_lines '[0-9.][eE]-[0-9]|0x[0-9a-fA-F.]+p-|epsilon\(\)' --include=*.h --include=*.cpp \
    --exclude=tolerances.h --exclude=shear.h)"
# Pictures are full of small sizes; elsewhere a constant or an option says what such a number means.
report "Small decimal without a name" \
  "$(source_lines '[^0-9A-Za-z_.]0?\.0[0-9]*[1-9]' --include=*.h --include=*.cpp --exclude-dir=rendering \
    --exclude=tolerances.h | grep -vE ':( *constexpr)? *double [a-z_]+ = 0\.0[0-9]+;|return 0\.0[0-9]+;' || true)"
# Not installed: rational_number.h, half_edge_mesh.h and solid_location.h, the doors to GMP, OpenMesh and CGAL for
# sources that compute with them, and the formats' own headers.
report "Installed header that shows a third-party library other than Eigen" \
  "$(source_lines '#include [<"](CGAL|OpenMesh|boost|vtk|tbb|gmp|mpfr|pugixml|minizip|unzip|zip\.h|tiny_gltf|nlohmann|GL/|EGL/)' \
    --include=*.h --exclude=rational_number.h --exclude=half_edge_mesh.h --exclude=solid_location.h --exclude-dir=formats)"
report "Output from the library" \
  "$(source_lines '(std::(cout|cerr|clog)|[^a-z_]f?printf *\(|[^a-z_]puts *\()' --include=*.h --include=*.cpp)"
report "Header without include guard" "$(grep -rLx '#pragma once' --include=*.h src || true)"

# Rooms may include only these rooms.
declare -A allowed=(
  [shape]='shape'
  [envelope]='shape|envelope'
  [stacking]='shape|envelope|stacking'
  [structure]='shape|structure'
  [deformation]='shape|structure|deformation'
  [improvement]='shape|envelope|stacking|structure|deformation|improvement'
  [rendering]='shape|envelope|stacking|structure|deformation|improvement|rendering'
)
for room in src/stackabilization/*/; do
  name=$(basename "$room")
  if [[ -z ${allowed[$name]:-} ]]; then
    report "Room without a rule in scripts/check_source.sh" "$room"
    continue
  fi
  report "Room $name reaches back" \
    "$(grep -rnE '#include "' "$room" | grep -vE "#include \"stackabilization/(${allowed[$name]})/" || true)"
done

# Absolute paths of somebody's machine, in everything that is versioned.
report "Absolute path" "$(git grep -nIE "(^|[^A-Za-z0-9_.\$}])/(home|root|work|tmp|mnt|Users)/" -- . \
  ':!scripts/check_source.sh' 2>/dev/null || true)"

exit "$broken"
