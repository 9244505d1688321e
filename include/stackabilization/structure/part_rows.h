#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Parts of nearly the same form at even steps along a line, such as slats, rungs and spindles: a
/// translational pattern of one parameter [Pauly et al. 2008].
struct PartRow {
  std::vector<int> parts;  ///< rows of Structure::parts, at least 3, in order along the line
  /// Per part, its control points that correspond to those of the first part, in their order.
  std::vector<std::vector<int>> control_points;
};

/// Finds the rows of a structure by its primitives at rest. The steps of a row are even for all
/// control points, within tolerance::row_step and tolerance::row_evenness, and consecutive parts differ in
/// form by at most tolerance::row_form of their own diagonals. A row is as long as it can be, and goes from
/// each part to the nearest one of its form within 60 degrees, so that neither every second part makes a row
/// nor the diagonals of a grid do. A part may be in several rows. In order of the parts. Structures of more
/// than tolerance::max_parts_in_rows parts have none, since all pairs are looked at.
std::vector<PartRow> find_part_rows(const Structure& structure);

}  // namespace stackabilization
