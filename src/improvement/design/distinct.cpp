#include "improvement/design/distinct.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "core/disjoint_sets.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/improvement/shape_change.h"

namespace stackabilization::detail {

namespace {

/// Two designs are different if the change between them is at least this fraction of the smaller of their
/// changes from rest: far_apart for equal signatures, apart for different ones.
constexpr double far_apart = 0.5;
constexpr double apart = 0.1;

void set_direction(EditSignature& signature, const Eigen::Vector3d& vector) {
  const double length = vector.norm();
  if (!(length > 0)) return;
  signature.x = static_cast<int>(std::lround(vector.x() / length));
  signature.y = static_cast<int>(std::lround(vector.y() / length));
  signature.z = static_cast<int>(std::lround(vector.z() / length));
}

}  // namespace

SolutionDiversity::SolutionDiversity(const StructuredShape& rest) : rest_(rest) {
  const std::size_t count = rest.structure.parts.size();
  DisjointSets classes(count);
  for (const Relation& relation : rest.structure.relations)
    if (relation.type == RelationType::symmetry)
      classes.join(static_cast<std::size_t>(relation.parts[0]), static_cast<std::size_t>(relation.parts[1]));
  for (std::size_t part = 0; part < count; ++part)
    part_class_.push_back(static_cast<int>(classes.root(part)));
}

EditSignature SolutionDiversity::signature(const Edit& edit) const {
  EditSignature signature;
  const auto part = static_cast<std::size_t>(edit.handle.part);
  if (part < part_class_.size()) signature.part_class = part_class_[part];
  signature.handle_kind = static_cast<int>(edit.handle.kind);
  signature.index = edit.handle.index;
  signature.operation = static_cast<int>(edit.operation.index());
  signature.falloff = static_cast<int>(edit.falloff);
  if (const auto* move = std::get_if<Move>(&edit.operation)) set_direction(signature, move->by);
  if (const auto* lean = std::get_if<Lean>(&edit.operation)) set_direction(signature, lean->by);
  if (const auto* turn = std::get_if<Rotate>(&edit.operation)) set_direction(signature, turn->axis);
  if (const auto* scale = std::get_if<Scale>(&edit.operation)) signature.x = scale->factor > 1 ? 1 : -1;
  if (const auto* taper = std::get_if<Taper>(&edit.operation)) {
    signature.x = taper->factor > 1 ? 1 : -1;
    if (taper->along) set_direction(signature, *taper->along);
  }
  return signature;
}

std::vector<EditSignature> SolutionDiversity::signatures(const std::vector<Edit>& edits) const {
  std::vector<EditSignature> signatures;
  for (const Edit& edit : edits) signatures.push_back(signature(edit));
  std::sort(signatures.begin(), signatures.end());
  signatures.erase(std::unique(signatures.begin(), signatures.end()), signatures.end());
  return signatures;
}

bool SolutionDiversity::differ(const Design& a, const Design& b) const {
  const auto change = [](const Shape& from, const Shape& to) {
    return shape_change(from, to).root_mean_square;
  };
  const double from_rest = std::min(change(rest_.shape, a.shape), change(rest_.shape, b.shape));
  const double between = change(a.shape, b.shape);
  const bool same_gestures = signatures(a.edits) == signatures(b.edits);
  return between > tolerance::relative && between >= (same_gestures ? far_apart : apart) * from_rest;
}

}  // namespace stackabilization::detail
