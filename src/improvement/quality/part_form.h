#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "improvement/quality/affine_fit.h"
#include "improvement/quality/centre_line.h"
#include "improvement/quality/surface_marks.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// What the change of a part is measured with.
struct PartForm {
  SurfaceMarks marks;              ///< points of equal area; none for a part without area
  std::optional<AffineFit> fit;    ///< of the marks; empty for a part without area
  std::optional<CentreLine> line;  ///< of an elongated part
};

/// Prepares the form of a part at rest. `triangles`: those of the part; `max_pieces`: of its centre line.
PartForm part_form(const StructuredShape& rest, std::size_t part, const std::vector<std::int32_t>& triangles,
                   std::size_t max_pieces = CentreLine::default_pieces);

}  // namespace stackabilization::detail
