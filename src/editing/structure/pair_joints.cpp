#include "editing/structure/pair_joints.h"

#include <algorithm>
#include <string>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/structure/joints.h"

namespace stackabilization::editing {

namespace {

constexpr double max_reach = 0.25;  ///< of two parts that are joined by hand; JointOptions::reach

bool joins(const Relation& relation, int first, int second) {
  return is_joint(relation) && std::is_permutation(relation.parts.begin(), relation.parts.end(),
                                                   std::vector<int>{first, second}.begin());
}

/// The shape with only these two parts.
StructuredShape pair_of(const StructuredShape& structured, int first, int second) {
  std::vector<int> others;
  for (int part = 0; part < static_cast<int>(structured.structure.parts.size()); ++part)
    if (part != first && part != second) others.push_back(part);
  return others.empty() ? structured : without_parts(structured, others);
}

}  // namespace

bool is_joint(const Relation& relation) {
  return relation.type == RelationType::point_joint || relation.type == RelationType::line_joint;
}

std::vector<Relation> joints_between(const StructuredShape& structured, int first, int second) {
  const std::vector<Part>& parts = structured.structure.parts;
  const std::string names = "'" + parts.at(static_cast<std::size_t>(first)).name + "' and '" +
                            parts.at(static_cast<std::size_t>(second)).name + "'";
  if (first == second) throw UsageError("a part cannot be joined to itself");
  for (const Relation& relation : structured.structure.relations)
    if (joins(relation, first, second)) throw UsageError(names + " are joined already");
  const StructuredShape pair = pair_of(structured, first, second);
  JointOptions options;
  for (; options.reach <= max_reach; options.reach = std::min(2 * options.reach, max_reach)) {
    std::vector<Relation> joints = find_joints(pair.shape, pair.structure.parts, options);
    if (!joints.empty()) {
      for (Relation& joint : joints)
        for (int& part : joint.parts) part = part == 0 ? std::min(first, second) : std::max(first, second);
      return joints;
    }
    if (options.reach == max_reach) break;
  }
  throw UsageError(names + " are too far apart to be joined");
}

}  // namespace stackabilization::editing
