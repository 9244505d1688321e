#include "stackabilization/improvement/partition.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/disjoint_sets.h"
#include "improvement/design/best_measured.h"
#include "improvement/design/members.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

using Groups = std::vector<std::vector<int>>;

/// Returns the components connected by joints, after cutting the joints between the class `members` and other
/// parts.
Groups pieces_without_joints_of(const Structure& structure, const std::vector<int>& members) {
  std::vector<char> inside(structure.parts.size(), 0);
  for (const int part : members) inside[static_cast<std::size_t>(part)] = 1;
  DisjointSets sets(structure.parts.size());
  for (const Relation& relation : structure.relations) {
    if (!relation.is_joint()) continue;
    const auto a = static_cast<std::size_t>(relation.parts[0]),
               b = static_cast<std::size_t>(relation.parts[1]);
    if (inside[a] == inside[b]) sets.join(a, b);
  }
  return detail::members_of(sets, structure.parts.size());
}

/// Measures the partition of an object with box volume V(M) = `box_volume` into these groups.
Partition measured(const StructuredShape& structured, const Groups& groups, double box_volume,
                   const RemovalOptions& options) {
  Partition partition;
  double left = 0;
  const std::vector<StructuredShape> shapes = split_into_groups(structured, groups);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    Piece piece;
    piece.parts = groups[k];
    if (const auto best = detail::best_measured(shapes[k].shape, options.measure, options.directions)) {
      piece.direction = best->direction;
      piece.stackability = best->value;
      left += best->box_volume * (1 - best->value);
    }
    partition.pieces.push_back(std::move(piece));
  }
  partition.stackability = 1 - left / box_volume;
  return partition;
}

}  // namespace

std::vector<Partition> suggested_partitions(const StructuredShape& structured,
                                            const PartitionOptions& options) {
  const auto whole = detail::best_measured(structured.shape, options.measure, options.directions);
  if (!whole) throw InputError("the shape has no volume, so its pieces cannot be compared with it");
  const Groups uncut = pieces_without_joints_of(structured.structure, {});
  std::vector<Groups> cuts;
  for (const std::vector<int>& members : symmetric_classes(structured.structure)) {
    Groups groups = pieces_without_joints_of(structured.structure, members);
    if (groups.size() <= options.max_pieces && groups != uncut &&
        std::find(cuts.begin(), cuts.end(), groups) == cuts.end())
      cuts.push_back(std::move(groups));
  }
  std::vector<std::optional<Partition>> found(cuts.size());
  tbb::parallel_for(std::size_t{0}, cuts.size(), [&](std::size_t k) {
    if (!options.cancelled || !options.cancelled())
      found[k] = measured(structured, cuts[k], whole->box_volume, options);
  });
  std::vector<Partition> partitions;
  for (auto& partition : found)
    if (partition) partitions.push_back(std::move(*partition));
  std::stable_sort(partitions.begin(), partitions.end(), [](const Partition& a, const Partition& b) {
    if (a.stackability != b.stackability) return a.stackability > b.stackability;
    return a.pieces.size() < b.pieces.size();
  });
  return partitions;
}

}  // namespace stackabilization
