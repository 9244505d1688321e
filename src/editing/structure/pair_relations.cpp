#include "editing/structure/pair_relations.h"

#include <algorithm>
#include <string>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/structure/joints.h"
#include "stackabilization/structure/symmetry_detection.h"

namespace stackabilization::editing {

namespace {

constexpr double max_reach = 0.25;        ///< of two parts that are joined by hand; JointOptions::reach
constexpr double given_tolerance = 0.03;  ///< of parts that are said to be symmetric; SymmetryOptions

/// Two parts of a shape, and the shape with only these.
class Pair {
 public:
  /// Throws UsageError when the parts are one, with what cannot be done then.
  Pair(const StructuredShape& structured, int first, int second, const std::string& impossible)
      : structured_(structured), low_(std::min(first, second)), high_(std::max(first, second)) {
    if (first == second) throw UsageError("a part cannot be " + impossible + " itself");
    std::vector<int> others;
    for (int part = 0; part < static_cast<int>(structured.structure.parts.size()); ++part)
      if (part != first && part != second) others.push_back(part);
    alone_ = others.empty() ? structured : without_parts(structured, others);
  }

  const StructuredShape& alone() const { return alone_; }
  std::string names() const { return "'" + name(low_) + "' and '" + name(high_) + "'"; }
  /// Does a relation of the whole shape relate the two?
  template <class Condition>
  bool any_relation(const Condition& condition) const {
    const std::vector<Relation>& relations = structured_.structure.relations;
    return std::any_of(relations.begin(), relations.end(), [&](const Relation& relation) {
      std::vector<int> parts = relation.parts;
      std::sort(parts.begin(), parts.end());
      return parts == std::vector<int>{low_, high_} && condition(relation);
    });
  }
  /// Returns a relation of the two alone as one of the whole shape. Residuals are fractions of a diagonal.
  Relation in_whole(Relation relation) const {
    for (int& part : relation.parts) part = part == 0 ? low_ : high_;
    relation.residual *= alone_.structure.diagonal / structured_.structure.diagonal;
    return relation;
  }

 private:
  const std::string& name(int part) const {
    return structured_.structure.parts.at(static_cast<std::size_t>(part)).name;
  }

  const StructuredShape& structured_;
  int low_, high_;
  StructuredShape alone_;
};

}  // namespace

std::vector<Relation> joints_between(const StructuredShape& structured, int first, int second) {
  const Pair pair(structured, first, second, "joined to");
  if (pair.any_relation([](const Relation& relation) { return relation.is_joint(); }))
    throw UsageError(pair.names() + " are joined already");
  JointOptions options;
  for (; options.reach <= max_reach; options.reach = std::min(2 * options.reach, max_reach)) {
    std::vector<Relation> joints = find_joints(pair.alone().shape, pair.alone().structure.parts, options);
    if (!joints.empty()) {
      for (Relation& joint : joints) joint = pair.in_whole(std::move(joint));
      return joints;
    }
    if (options.reach == max_reach) break;
  }
  throw UsageError(pair.names() + " are too far apart to be joined");
}

Relation symmetry_between(const StructuredShape& structured, int first, int second) {
  const Pair pair(structured, first, second, "symmetric to");
  if (pair.any_relation([](const Relation& relation) { return relation.type == RelationType::symmetry; }))
    throw UsageError(pair.names() + " are symmetric already");
  std::vector<FoundSymmetry> of_whole;
  for (const Symmetry& symmetry : structured.structure.symmetries) of_whole.push_back({symmetry, 0, 1});
  SymmetryOptions options;
  options.tolerance = given_tolerance;
  const Shape& shape = pair.alone().shape;
  for (const std::vector<FoundSymmetry>& symmetries : {of_whole, find_symmetries(shape, options)})
    for (Relation& relation : symmetry_relations(shape, symmetries, options))
      if (relation.type == RelationType::symmetry) return pair.in_whole(std::move(relation));
  throw UsageError(pair.names() + " are no mirror images of each other");
}

}  // namespace stackabilization::editing
