#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Returns a structured shape without some of its parts. The other parts keep their order, their triangles
/// with the vertices used, their primitives and their relations. A global symmetry is kept unless it maps a
/// part that stays onto one that is removed. Throws UsageError when a part does not exist, or when no part,
/// no triangle or no extent would be left.
StructuredShape without_parts(const StructuredShape& structured, const std::vector<int>& parts);

/// Cuts a shape at its joints into groups of parts (paper, Fig. 14). Returns one structured shape per group,
/// in the order of the groups, each as `without_parts` makes it. Throws UsageError unless every part is in
/// exactly one group and no group is empty.
std::vector<StructuredShape> split_into_groups(const StructuredShape& structured,
                                               const std::vector<std::vector<int>>& groups);

/// Returns the classes of parts that symmetry relations connect, directly or through other parts. Every part
/// is in one class. Parts ascend within a class; classes are ordered by their first parts.
std::vector<std::vector<int>> symmetric_classes(const Structure& structure);

/// A removal of parts, and the stackability of the rest.
struct Removal {
  std::vector<int> parts;                                ///< a class of symmetric parts
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< of largest S of the rest, of those tried
  double stackability = 0;                               ///< S of the rest along `direction`
  double area = 0;                                       ///< of the parts, fraction of the surface
};

/// Options of `removals`.
struct RemovalOptions {
  /// Meaning of S. `flat_shapes` is ignored: a rest without volume has no S.
  StackabilityOptions measure;
  /// Directions to try, at least one. The direction of largest S counts; ties: the first.
  std::vector<Eigen::Vector3d> directions = {{0, 0, 1}};
  /// Asked before each class, from any thread. Once it returns true, the remaining classes are skipped.
  std::function<bool()> cancelled = {};
};

/// Returns every class of symmetric parts whose removal leaves a shape with a volume, largest S first (ties:
/// by parts). The result is the same for any number of threads. Throws UsageError without directions.
std::vector<Removal> removals(const StructuredShape& structured, const RemovalOptions& options = {});

}  // namespace stackabilization
