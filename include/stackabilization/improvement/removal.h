#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// A structured shape without some of its parts: triangles with the vertices they use, primitives and
/// relations of the others, in their order. Global symmetries stay unless one of them takes a part that is
/// left to one that is removed. Throws UsageError when nothing would be left or a part does not exist.
StructuredShape without_parts(const StructuredShape& structured, const std::vector<int>& parts);

/// The pieces of a shape cut at its joints into groups of parts, each a structured shape of its own as
/// `without_parts` makes it, in the order of the groups (paper, Fig. 14). Throws UsageError unless every part
/// is in one group and no group is empty.
std::vector<StructuredShape> partitioned(const StructuredShape& structured,
                                         const std::vector<std::vector<int>>& groups);

/// Parts that symmetry relations tie together, directly or through others: every part is in one class, the
/// parts of a class ascending, the classes by their first parts.
std::vector<std::vector<int>> symmetric_classes(const Structure& structure);

/// A removal, and how the rest stacks.
struct Removal {
  std::vector<int> parts;                                ///< a class of symmetric parts
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< along which the rest stacks best, of those tried
  double stackability = 0;                               ///< S of the rest along it
};

/// How what is left is measured.
struct RemovalOptions {
  StackabilityOptions measure;  ///< `flat_shapes` is not looked at: a rest without volume has no S
  /// That are tried, at least one; the best one counts, among equals the first.
  std::vector<Eigen::Vector3d> directions = {{0, 0, 1}};
  /// Asked before each class, from any thread; when it returns true, the classes that are left are left out.
  std::function<bool()> cancelled = {};
};

/// Every class of symmetric parts whose removal leaves something with a volume, largest S first (ties: by
/// parts). The same for any number of threads. Throws UsageError without directions.
std::vector<Removal> removals(const StructuredShape& structured, const RemovalOptions& options = {});

}  // namespace stackabilization
