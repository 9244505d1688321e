#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// A structured shape without some of its parts: triangles, primitives and relations of the others; global
/// symmetries stay. Throws UsageError when nothing would be left or a part does not exist.
StructuredShape without_parts(const StructuredShape& structured, const std::vector<int>& parts);

/// The pieces of a shape cut at its joints into groups of parts, each a structured shape of its own, in the
/// order of the groups (paper, Fig. 14). Throws UsageError unless every part is in one group.
std::vector<StructuredShape> partitioned(const StructuredShape& structured,
                                         const std::vector<std::vector<int>>& groups);

/// A removal, and how the rest stacks.
struct Removal {
  std::vector<int> parts;  ///< a part and all that are symmetric to it
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  double stackability = 0;  ///< S of the rest along it
};

struct RemovalOptions {
  StackabilityOptions measure;
  std::vector<Eigen::Vector3d> directions = {{0, 0, 1}};  ///< that are tried; the best one counts
};

/// Every class of symmetric parts whose removal leaves something, largest S first (ties: by parts).
std::vector<Removal> removals(const StructuredShape& structured, const RemovalOptions& options = {});

}  // namespace stackabilization
