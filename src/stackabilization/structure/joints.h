#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

struct JointOptions {
  /// Parts whose surfaces come nearer than this meet, fraction of the bounding-box diagonal of the shape.
  double reach = 0.01;
  /// A contact this many times longer than wide, and longer than `least_line`, is a line joint.
  double line_aspect = 4;
  /// Shortest line joint, fraction of the smaller part's diagonal.
  double least_line = 0.25;
};

/// Point and line joints of every pair of parts, from the region that both primitives (and, where they are mere boxes,
/// the surfaces in them) have in common: compact regions give a point joint at their centroid, elongated ones a line
/// joint between their ends, separate regions one joint each. Independent of pose and scale. `parts` are those of
/// `shape`, in its order.
std::vector<Relation> find_joints(const Shape& shape, const std::vector<Part>& parts, const JointOptions& options = {});

}  // namespace stackabilization
