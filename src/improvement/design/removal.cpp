#include "stackabilization/improvement/removal.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/angles.h"
#include "core/bounding_diagonal.h"
#include "core/disjoint_sets.h"
#include "improvement/design/best_measured.h"
#include "improvement/design/members.h"
#include "mesh/surface_moments.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization {

namespace {

void require_part(const StructuredShape& structured, int part) {
  if (part < 0 || static_cast<std::size_t>(part) >= structured.structure.parts.size())
    throw UsageError("there is no part " + std::to_string(part));
}

/// Old rows of the parts that stay, and the new row of every old part (-1: removed).
struct Selection {
  std::vector<int> rows;
  std::vector<int> renumbered;
};

Selection selection_of(const StructuredShape& structured, std::vector<int> parts) {
  std::sort(parts.begin(), parts.end());
  Selection selection{std::move(parts), std::vector<int>(structured.structure.parts.size(), -1)};
  for (std::size_t k = 0; k < selection.rows.size(); ++k)
    selection.renumbered[static_cast<std::size_t>(selection.rows[k])] = static_cast<int>(k);
  return selection;
}

Shape selected(const Shape& shape, const Selection& selection) {
  std::vector<std::int32_t> triangles, parts;
  for (std::int32_t t = 0; t < shape.triangle_count(); ++t) {
    const auto part = static_cast<std::size_t>(shape.triangle_part[static_cast<std::size_t>(t)]);
    if (selection.renumbered[part] < 0) continue;
    triangles.push_back(t);
    parts.push_back(selection.renumbered[part]);
  }
  if (triangles.empty()) throw UsageError("parts without triangles cannot stand alone");
  Shape result = detail::extracted(shape, triangles);
  result.unit = shape.unit;
  result.triangle_part = std::move(parts);
  result.part_names.clear();
  for (const int row : selection.rows)
    result.part_names.push_back(shape.part_names[static_cast<std::size_t>(row)]);
  return result;
}

/// Returns whether two symmetries have the same mirror plane or the same axis, so that one repeats the other
/// or a power of it.
bool same_mirror_or_axis(const Symmetry& a, const Symmetry& b, double diagonal) {
  const bool reflects = a.kind == SymmetryKind::reflection;
  if (reflects != (b.kind == SymmetryKind::reflection)) return false;
  const Eigen::Vector3d between = b.point - a.point;
  const double off = reflects ? std::abs(a.axis.dot(between)) : a.axis.cross(between).norm();
  return detail::on_one_line(a.axis, b.axis, tolerance::same_symmetry) &&
         off <= tolerance::same_symmetry * diagonal;
}

Structure selected(const Structure& structure, const Selection& selection, double diagonal) {
  Structure result;
  result.diagonal = diagonal;
  for (const int row : selection.rows) result.parts.push_back(structure.parts[static_cast<std::size_t>(row)]);
  std::vector<const Symmetry*> broken;
  for (const Relation& relation : structure.relations) {
    Relation kept = relation;
    for (int& part : kept.parts) part = selection.renumbered[static_cast<std::size_t>(part)];
    const auto lost = std::count(kept.parts.begin(), kept.parts.end(), -1);
    if (lost == 0) {
      kept.residual *= structure.diagonal / diagonal;
      result.relations.push_back(std::move(kept));
    } else if (relation.type == RelationType::symmetry && lost == 1) {
      broken.push_back(&relation.symmetry);
    }
  }
  for (const Symmetry& symmetry : structure.symmetries) {
    const auto breaks = [&](const Symmetry* other) {
      return same_mirror_or_axis(symmetry, *other, structure.diagonal);
    };
    if (std::none_of(broken.begin(), broken.end(), breaks)) result.symmetries.push_back(symmetry);
  }
  return result;
}

StructuredShape selected(const StructuredShape& structured, std::vector<int> parts) {
  const Selection selection = selection_of(structured, std::move(parts));
  StructuredShape result;
  result.shape = selected(structured.shape, selection);
  const double diagonal = bounding_diagonal(result.shape);
  if (!(diagonal > 0)) throw UsageError("parts without extent cannot stand alone");
  result.structure = selected(structured.structure, selection, diagonal);
  return result;
}

/// Returns the area of every part, as a fraction of that of all.
Eigen::VectorXd area_fractions(const StructuredShape& structured) {
  const Shape& shape = structured.shape;
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(structured.structure.parts.size()));
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    areas[shape.triangle_part[static_cast<std::size_t>(t)]] += detail::area_vector(shape, t).norm();
  const double all = areas.sum();
  return all > 0 ? Eigen::VectorXd(areas / all) : areas;
}

std::vector<int> all_but(const StructuredShape& structured, const std::vector<int>& parts) {
  const std::set<int> left_out(parts.begin(), parts.end());
  std::vector<int> others;
  for (int part = 0; part < static_cast<int>(structured.structure.parts.size()); ++part)
    if (!left_out.contains(part)) others.push_back(part);
  return others;
}

}  // namespace

std::vector<std::vector<int>> symmetric_classes(const Structure& structure) {
  DisjointSets sets(structure.parts.size());
  for (const Relation& relation : structure.relations)
    if (relation.type == RelationType::symmetry)
      sets.join(static_cast<std::size_t>(relation.parts[0]), static_cast<std::size_t>(relation.parts[1]));
  return detail::members_of(sets, structure.parts.size());
}

StructuredShape without_parts(const StructuredShape& structured, const std::vector<int>& parts) {
  for (const int part : parts) require_part(structured, part);
  std::vector<int> others = all_but(structured, parts);
  if (others.empty()) throw UsageError("nothing would be left of the shape");
  return selected(structured, std::move(others));
}

std::vector<StructuredShape> split_into_groups(const StructuredShape& structured,
                                               const std::vector<std::vector<int>>& groups) {
  std::vector<int> uses(structured.structure.parts.size(), 0);
  for (const std::vector<int>& group : groups) {
    if (group.empty()) throw UsageError("a group of a partition has no part");
    for (const int part : group) {
      require_part(structured, part);
      ++uses[static_cast<std::size_t>(part)];
    }
  }
  for (std::size_t part = 0; part < uses.size(); ++part)
    if (uses[part] != 1)
      throw UsageError("part '" + structured.structure.parts[part].name + "' is in " +
                       std::to_string(uses[part]) + " groups of the partition, not in one");
  std::vector<StructuredShape> pieces;
  for (const std::vector<int>& group : groups) pieces.push_back(selected(structured, group));
  return pieces;
}

std::vector<Removal> removals(const StructuredShape& structured, const RemovalOptions& options) {
  const std::vector<std::vector<int>> classes = symmetric_classes(structured.structure);
  const Eigen::VectorXd areas = area_fractions(structured);
  std::vector<std::optional<Removal>> measured(classes.size());
  tbb::parallel_for(std::size_t{0}, classes.size(), [&](std::size_t k) {
    if (options.cancelled && options.cancelled()) return;
    std::vector<int> others = all_but(structured, classes[k]);
    if (others.empty()) return;
    const Shape rest = selected(structured, std::move(others)).shape;
    const auto best = detail::best_measured(rest, options.measure, options.directions);
    if (best) measured[k] = Removal{classes[k], best->direction, best->value, areas(classes[k]).sum()};
  });
  std::vector<Removal> result;
  for (auto& removal : measured)
    if (removal) result.push_back(std::move(*removal));
  std::stable_sort(result.begin(), result.end(),
                   [](const Removal& a, const Removal& b) { return a.stackability > b.stackability; });
  return result;
}

}  // namespace stackabilization
