#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Parts of nearly the same form at even steps along a line, such as slats, rungs and spindles: a
/// translational pattern of one parameter [Pauly et al. 2008].
struct PartRow {
  std::vector<int> parts;  ///< indices into Structure::parts, at least 3, in order along the line
  /// Per part, the indices of its control points, in the order of the corresponding ones of the first part.
  std::vector<std::vector<int>> control_points;
};

/// Finds the rows of a structure, by its primitives at rest. Control points and radii of three consecutive
/// parts of a row change by even steps, within tolerance::row_step and tolerance::row_evenness, and two
/// consecutive parts differ in form by at most tolerance::row_form. A row is as long as it can be, and goes
/// from each part to the nearest one of its form within 60 degrees: neither every second part makes a row nor
/// the diagonals of a grid do. A part may be in several rows. Rows are sorted by the end with the smaller
/// index. Structures of more than tolerance::max_parts_in_rows parts have none, since all pairs of parts are
/// looked at. Does not depend on pose and unit.
std::vector<PartRow> find_part_rows(const Structure& structure);

}  // namespace stackabilization
