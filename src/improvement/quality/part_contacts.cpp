#include "improvement/quality/part_contacts.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "core/index.h"
#include "mesh/segment_triangle.h"
#include "mesh/triangle_tree.h"
#include "stackabilization/improvement/tolerances.h"
#include "stackabilization/mesh/box_pairs.h"
#include "stackabilization/mesh/closed_surface.h"
#include "stackabilization/mesh/exact_triangles.h"

namespace stackabilization::detail {

namespace {

using ContactKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Number of marks on a part and, at rest, on a part and on all parts: the fewer parts, the more on each.
/// Number of marks around a joint.
constexpr int marks_per_part = 150;
constexpr int marks_at_rest = 3000;
constexpr int all_marks_at_rest = 60'000;
constexpr std::size_t marks_per_joint = 60;
/// Number of projections from one part to the other on the way to where they meet, even.
constexpr std::size_t projections = 4;
/// Largest number of pairs of parts near each other; more are not looked at.
constexpr std::size_t max_near_pairs = 20'000;

Corners corners_of(const Shape& shape, std::int32_t t) {
  return {shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2)};
}

/// Returns marks of equal area and, for the ends of rungs and tenons, the outermost vertices.
SurfaceMarks marks_of(const Shape& shape, const std::vector<std::int32_t>& triangles, int count) {
  SurfaceMarks marks = marks_on(shape, triangles, count);
  marks.append(outermost_vertices(shape, triangles));
  return marks;
}

double distance_between(const Corners& a, const Corners& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    least = std::min(least, approach({a[k], a[(k + 1) % 3]}, b, 0).distance);
    least = std::min(least, approach({b[k], b[(k + 1) % 3]}, a, 0).distance);
  }
  return least;
}

}  // namespace

/// Trees of the parts of a shape, made when they are needed. For one thread.
class PartContacts::Surfaces {
 public:
  explicit Surfaces(const Shape& shape)
      : shape_(shape), rows_(triangles_of_parts(shape)), trees_(rows_.size()) {
    boxes_.resize(rows_.size());
    for (std::size_t part = 0; part < rows_.size(); ++part)
      for (const std::int32_t t : rows_[part])
        for (int k = 0; k < 3; ++k) boxes_[part].extend(shape.corner(t, k));
  }

  const Eigen::AlignedBox3d& box(int part) const { return boxes_[at(part)]; }
  const std::vector<Eigen::AlignedBox3d>& boxes() const { return boxes_; }
  const std::vector<std::int32_t>& rows(int part) const { return rows_[at(part)]; }

  /// Returns the distance from a point to the part; infinite if the part has no area.
  double distance(int part, const Eigen::Vector3d& p) const {
    const Tree* const found = tree(part);
    return found ? (found->nearest(p).point - p).norm() : std::numeric_limits<double>::infinity();
  }
  bool has_area(int part) const { return tree(part) != nullptr; }
  /// Returns the point of the part that is nearest to a point. Precondition: the part has area.
  Eigen::Vector3d nearest(int part, const Eigen::Vector3d& p) const { return tree(part)->nearest(p).point; }
  /// Returns whether a point lies inside the closed surface of the part, by the parity of a ray.
  bool contains(int part, const Eigen::Vector3d& p) const {
    if (!box(part).contains(p)) return false;
    // A direction that is parallel to no face and meets no edge of a modelled object.
    const Eigen::Vector3d along(0.5477, 0.3163, 0.7746);
    const Tree* const found = tree(part);
    return found && found->count_hits(p, along) % 2 == 1;
  }

 private:
  using Tree = TriangleTree<ContactKernel>;

  const Tree* tree(int part) const {
    std::unique_ptr<Tree>& entry = trees_[at(part)];
    if (!entry) {
      std::vector<std::int32_t> rows;
      for (const std::int32_t t : rows_[at(part)])
        if (!are_collinear(shape_.corner(t, 0), shape_.corner(t, 1), shape_.corner(t, 2))) rows.push_back(t);
      if (rows.empty()) return nullptr;
      entry = std::make_unique<Tree>(shape_, std::move(rows));
    }
    return entry.get();
  }

  const Shape& shape_;
  std::vector<std::vector<std::int32_t>> rows_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  mutable std::vector<std::unique_ptr<Tree>> trees_;
};

PartContacts::PartContacts(const StructuredShape& rest) : rest_(rest), welded_(weld(rest.shape)) {
  const Shape& shape = rest.shape;
  const Surfaces surfaces(shape);
  for (int part = 0; part < static_cast<int>(shape.part_count()); ++part) {
    marks_.push_back(marks_of(shape, surfaces.rows(part), marks_per_part));
    solid_.push_back(closed_surface(extract_part(shape, part)).closed);
  }
  crossing_at_rest_ = intersections(shape);
  find_touching(surfaces);
  find_joints(surfaces);
}

void PartContacts::find_touching(const Surfaces& surfaces) {
  const Shape& shape = rest_.shape;
  const double reach = tolerance::quality::touching * rest_.structure.diagonal;
  std::set<std::pair<int, int>> touching;
  for (const auto& [a, b] : crossing_at_rest_) {
    const int first = shape.triangle_part[at(a)], second = shape.triangle_part[at(b)];
    if (first != second) touching.insert(std::minmax({first, second}));
  }
  for (const Relation& relation : rest_.structure.relations)
    if (relation.is_joint()) touching.insert(std::minmax({relation.parts.front(), relation.parts.back()}));
  const auto near = near_boxes(surfaces.boxes(), reach, max_near_pairs);
  for (const auto& [first, second] : near.value_or(BoxPairs{})) {
    if (touching.contains({first, second})) continue;
    const auto reaches = [&](int part, int other) {
      Eigen::AlignedBox3d box = surfaces.box(other);
      box.min().array() -= reach;
      box.max().array() += reach;
      const auto is_near = [&](const Eigen::Vector3d& p) {
        return box.contains(p) &&
               (surfaces.distance(other, p) <= reach || (solid_[at(other)] && surfaces.contains(other, p)));
      };
      const Points places = marks_[at(part)].on(shape);
      for (const auto place : places.rowwise())
        if (is_near(place.transpose())) return true;
      for (const std::int32_t t : surfaces.rows(part))
        for (int k = 0; k < 3; ++k)
          if (is_near(shape.corner(t, k))) return true;
      return false;
    };
    if (reaches(first, second) || reaches(second, first)) touching.insert({first, second});
  }
  // With more marks than later on, besides those: what lies inside of another part at rest must not count as
  // deeper where a few marks happen to come upon it.
  const int count =
      std::clamp(all_marks_at_rest / static_cast<int>(shape.part_count()), marks_per_part, marks_at_rest);
  std::map<int, SurfaceMarks> dense;
  const auto marks = [&](int part) -> const SurfaceMarks& {
    const auto [entry, is_new] = dense.try_emplace(part);
    if (is_new) entry->second = marks_on(shape, surfaces.rows(part), count);
    return entry->second;
  };
  for (const auto& [first, second] : touching)
    touching_.push_back(
        {first, second,
         std::max({depth(surfaces, shape, first, second), depth(surfaces, shape, marks(first), second),
                   depth(surfaces, shape, marks(second), first)})});
}

/// Returns the corners and the marks of a part that are nearest to a point.
SurfaceMarks PartContacts::marks_near(const Surfaces& surfaces, int part,
                                      const Eigen::Vector3d& point) const {
  const Shape& shape = rest_.shape;
  SurfaceMarks all = marks_[at(part)];
  for (const std::int32_t t : surfaces.rows(part))
    for (int k = 0; k < 3; ++k) all.append_corner(t, k);
  const Points places = all.on(shape);
  std::vector<std::pair<double, std::size_t>> nearest;
  for (std::size_t i = 0; i < all.size(); ++i)
    nearest.emplace_back((places.row(static_cast<Eigen::Index>(i)).transpose() - point).norm(), i);
  const std::size_t count = std::min(nearest.size(), marks_per_joint);
  std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count), nearest.end());
  SurfaceMarks marks;
  for (std::size_t i = 0; i < count; ++i) {
    marks.triangles.push_back(all.triangles[nearest[i].second]);
    marks.weights.push_back(all.weights[nearest[i].second]);
  }
  return marks;
}

void PartContacts::find_joints(const Surfaces& surfaces) {
  for (const Relation& relation : rest_.structure.relations) {
    if (!relation.is_joint()) continue;
    for (const auto point : relation.points.rowwise()) {
      Joint joint;
      joint.parts = {relation.parts.front(), relation.parts.back()};
      for (std::size_t side = 0; side < 2; ++side)
        joint.marks[side] = marks_near(surfaces, joint.parts[side], point.transpose());
      joint.gap = gap(surfaces, rest_.shape, joint);
      joints_.push_back(std::move(joint));
    }
  }
}

std::vector<PartContacts::TrianglePair> PartContacts::intersections(const Shape& shape) const {
  // Vertices of equal places at rest are one corner, wherever they are now.
  Points points(welded_.points.rows(), 3);
  for (Eigen::Index row = 0; row < points.rows(); ++row)
    points.row(row) = shape.vertices.row(welded_.first_vertex[static_cast<std::size_t>(row)]);
  return self_intersections(points, welded_.triangles);
}

bool PartContacts::touch(int first, int second) const {
  return std::any_of(touching_.begin(), touching_.end(),
                     [&](const Pair& pair) { return pair.first == first && pair.second == second; });
}

double PartContacts::distance_at_rest(const TrianglePair& pair) const {
  for (const std::int32_t t : {pair.first, pair.second})
    if (are_collinear(rest_.shape.corner(t, 0), rest_.shape.corner(t, 1), rest_.shape.corner(t, 2))) return 0;
  return distance_between(corners_of(rest_.shape, pair.first), corners_of(rest_.shape, pair.second));
}

double PartContacts::depth(const Surfaces& surfaces, const Shape& shape, const SurfaceMarks& marks,
                           int other) const {
  double deepest = 0;
  if (!solid_[at(other)]) return deepest;
  const Points places = marks.on(shape);
  for (const auto place : places.rowwise())
    if (surfaces.contains(other, place.transpose()))
      deepest = std::max(deepest, surfaces.distance(other, place.transpose()));
  return deepest;
}

double PartContacts::depth(const Surfaces& surfaces, const Shape& shape, int first, int second) const {
  return std::max(depth(surfaces, shape, marks_[at(first)], second),
                  depth(surfaces, shape, marks_[at(second)], first));
}

double PartContacts::gap(const Surfaces& surfaces, const Shape& shape, const Joint& joint) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t side = 0; side < 2; ++side) {
    const int other = joint.parts[1 - side];
    const Points places = joint.marks[side].on(shape);
    for (const auto place : places.rowwise()) {
      if (solid_[at(other)] && surfaces.contains(other, place.transpose())) return 0;
      least = std::min(least, surfaces.distance(other, place.transpose()));
    }
  }
  if (!(least > tolerance::quality::touching * rest_.structure.diagonal) ||
      !surfaces.has_area(joint.parts[0]) || !surfaces.has_area(joint.parts[1]))
    return least;
  // Where a joint slid, marks slid off it: projections to and fro lead to where the surfaces still meet.
  for (std::size_t side = 0; side < 2; ++side) {
    const Points places = joint.marks[side].on(shape);
    for (const auto place : places.rowwise()) {
      Eigen::Vector3d point = place.transpose();
      for (std::size_t k = 0; k < projections; ++k)
        point = surfaces.nearest(joint.parts[k % 2 == 0 ? 1 - side : side], point);
      least = std::min(least, surfaces.distance(joint.parts[1 - side], point));
    }
  }
  return least;
}

std::vector<QualityValue> PartContacts::measure(const Shape& now) const {
  const double diagonal = rest_.structure.diagonal;
  QualityValue self{QualityMeasure::self_intersection}, collision{QualityMeasure::collision};
  QualityValue piercing{QualityMeasure::piercing}, joints{QualityMeasure::joints};
  std::vector<TrianglePair> fresh;
  const std::vector<TrianglePair> crossing = intersections(now);
  std::set_difference(crossing.begin(), crossing.end(), crossing_at_rest_.begin(), crossing_at_rest_.end(),
                      std::back_inserter(fresh));
  std::set<std::pair<int, int>> collided;
  for (const TrianglePair& pair : fresh) {
    const int first = now.triangle_part[at(pair.first)], second = now.triangle_part[at(pair.second)];
    const auto parts = std::minmax({first, second});
    if (first != second) {
      if (!touch(parts.first, parts.second)) collided.insert(parts);
    } else if (distance_at_rest(pair) > tolerance::quality::touching * diagonal) {
      if (self.part < 0) self.part = first;
      ++self.value;
    }
  }
  const Surfaces surfaces(now);
  // A part may also have come to lie wholly inside another one.
  const auto near = near_boxes(surfaces.boxes(), 0, max_near_pairs);
  for (const auto& [first, second] : near.value_or(BoxPairs{}))
    if (!touch(first, second) &&
        depth(surfaces, now, first, second) > tolerance::quality::touching * diagonal)
      collided.insert({first, second});
  collision.value = static_cast<double>(collided.size());
  if (!collided.empty()) std::tie(collision.part, collision.other) = *collided.begin();
  for (const Pair& pair : touching_) {
    const double deeper = (depth(surfaces, now, pair.first, pair.second) - pair.depth) / diagonal;
    if (deeper > piercing.value) piercing = {QualityMeasure::piercing, deeper, pair.first, pair.second};
  }
  for (const Joint& joint : joints_) {
    const double wider = (gap(surfaces, now, joint) - joint.gap) / diagonal;
    if (wider > joints.value) joints = {QualityMeasure::joints, wider, joint.parts[0], joint.parts[1]};
  }
  return {self, collision, piercing, joints};
}

}  // namespace stackabilization::detail
