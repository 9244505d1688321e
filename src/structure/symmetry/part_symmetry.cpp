#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"
#include "stackabilization/structure/symmetry_detection.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/symmetry/canonical_reflections.h"
#include "structure/symmetry/part_match.h"
#include "structure/symmetry/symmetry_candidates.h"
#include "structure/symmetry/symmetry_refinement.h"

namespace stackabilization {

namespace {

using detail::PartSurfaces;
using detail::SymmetrySurface;

/// Parts without a counterpart nearly match at so many tolerances.
constexpr double near_miss = 2;

constexpr double min_diagonal = 0.697, max_diagonal = 0.717;  // cosine

class PartSymmetry {
 public:
  PartSymmetry(const Shape& shape, const std::vector<FoundSymmetry>& symmetries,
               const SymmetryOptions& options)
      : options_(options), parts_(shape, options), relations_of_(static_cast<std::size_t>(parts_.count())) {
    for (const FoundSymmetry& found : symmetries) {
      if (found.symmetry.kind == SymmetryKind::reflection) candidates_.push_back(found.symmetry);
      if (found.symmetry.kind == SymmetryKind::rotation) rotations_.push_back(found.symmetry);
    }
    for (const FoundSymmetry& found : symmetries)
      if (found.symmetry.kind == SymmetryKind::revolution)
        for (const Symmetry& plane : detail::planes_through(found.symmetry)) candidates_.push_back(plane);
  }

  std::vector<Relation> run() {
    planes_ = detail::canonical_reflections(parts_.whole(), parts_.with_area(), candidates_);
    std::vector<std::vector<Relation>> under = relations_under(planes_);
    turn_by_half_a_right_angle(under);
    for (const std::vector<Relation>& of_plane : under) append(of_plane);
    add_oblique_planes();
    for (const Symmetry& rotation : rotations_) add_cycles(rotation);
    std::vector<std::vector<Relation>> own(static_cast<std::size_t>(parts_.count()));
    tbb::parallel_for(0, parts_.count(),
                      [&](int part) { own[static_cast<std::size_t>(part)] = own_relations(part); });
    for (const std::vector<Relation>& relations : own) append(relations);
    std::stable_sort(relations_.begin(), relations_.end(), [](const Relation& a, const Relation& b) {
      return std::pair(a.type, a.parts) < std::pair(b.type, b.parts);
    });
    return std::move(relations_);
  }

 private:
  bool has(int part, RelationType type) const {
    const std::vector<std::size_t>& rows = relations_of_[static_cast<std::size_t>(part)];
    return std::any_of(rows.begin(), rows.end(),
                       [&](std::size_t row) { return relations_[row].type == type; });
  }

  void append(const std::vector<Relation>& more) {
    for (const Relation& relation : more) {
      for (const int part : relation.parts)
        relations_of_[static_cast<std::size_t>(part)].push_back(relations_.size());
      relations_.push_back(relation);
    }
  }

  static Relation related(std::vector<int> parts, const Symmetry& symmetry, double residual) {
    const RelationType type = parts.size() == 1 ? RelationType::self_symmetry : RelationType::symmetry;
    return {type, std::move(parts), symmetry, {}, residual};
  }

  /// Returns the part that the image of `part` under `plane` matches best, and the residual. -1: none.
  std::pair<int, double> best_match(int part, const Symmetry& plane, double slack) const {
    std::pair<int, double> best{-1, 0};
    for (const int other : parts_.near_image(part, plane, slack))
      if (const auto residual = parts_.match(part, other, plane, slack);
          residual && (best.first < 0 || *residual < best.second))
        best = {other, *residual};
    return best;
  }

  /// Returns the part that the image of `part` under `plane` matches best, or else lies on, or else nearly
  /// matches: the plane is one of the whole shape, but a leg or a board is often a little off its place.
  std::pair<int, double> counterpart(int part, const Symmetry& plane) const {
    const std::pair<int, double> best = best_match(part, plane, 1);
    if (best.first >= 0) return best;
    if (const std::optional<PartSurfaces::Image> image = parts_.image_of(part, plane))
      return {image->part, image->residual};
    return best_match(part, plane, near_miss);
  }

  std::vector<Relation> relations_under(const Symmetry& plane) const {
    std::vector<std::pair<int, double>> counterparts(static_cast<std::size_t>(parts_.count()));
    tbb::parallel_for(0, parts_.count(), [&](int part) {
      counterparts[static_cast<std::size_t>(part)] = counterpart(part, plane);
    });
    std::vector<Relation> relations;
    for (int part = 0; part < parts_.count(); ++part) {
      const auto [other, residual] = counterparts[static_cast<std::size_t>(part)];
      if (other == part)
        relations.push_back(related({part}, plane, residual));
      else if (other > part && counterparts[static_cast<std::size_t>(other)].first == part)
        relations.push_back(related({part, other}, plane, residual));
    }
    return relations;
  }

  std::vector<std::vector<Relation>> relations_under(const std::vector<Symmetry>& planes) const {
    std::vector<std::vector<Relation>> relations;
    for (const Symmetry& plane : planes) relations.push_back(relations_under(plane));
    return relations;
  }

  /// Takes the planes between the selected ones where all that those make equal is equal under these, and
  /// more. The four legs of a round stool are two pairs under the planes through the legs, a cycle under
  /// those between them.
  void turn_by_half_a_right_angle(std::vector<std::vector<Relation>>& relations) {
    std::vector<Symmetry> between;
    for (const Symmetry& candidate : candidates_)
      if (meets_any_at(min_diagonal, max_diagonal, candidate)) between.push_back(candidate);
    if (between.size() < 2) return;
    for (const Symmetry& plane : planes_)
      if (std::all_of(between.begin(), between.end(), [&](const Symmetry& other) {
            return std::abs(plane.axis.dot(other.axis)) < detail::nearly_across;
          }))
        between.push_back(plane);
    std::vector<Symmetry> turned = detail::canonical_reflections(parts_.whole(), parts_.with_area(), between);
    if (turned.size() != planes_.size()) return;
    std::vector<std::vector<Relation>> more = relations_under(turned);
    DisjointSets selected = orbits(relations), other = orbits(more);
    for (std::size_t part = 0; part < static_cast<std::size_t>(parts_.count()); ++part)
      if (other.root(part) != other.root(selected.root(part))) return;
    if (other.count() == selected.count()) return;
    planes_ = std::move(turned);
    relations = std::move(more);
  }

  DisjointSets orbits(const std::vector<std::vector<Relation>>& relations) const {
    DisjointSets sets(static_cast<std::size_t>(parts_.count()));
    for (const std::vector<Relation>& of_plane : relations)
      for (const Relation& relation : of_plane) join(sets, relation);
    return sets;
  }

  /// Adds planes at other angles. Three legs, five legs: planes that are not orthogonal to the selected
  /// planes count when they give a part its first counterpart. Six legs: they also count when they alone make
  /// parts equal. The diagonals of a square do not count, because it may become a rectangle.
  void add_oblique_planes() {
    for (const Symmetry& candidate : candidates_) {
      if (meets_any_at(tolerance::parallel, 1, candidate)) continue;
      const Symmetry plane = detail::fitted_to(planes_, candidate);
      const std::vector<Relation> relations = relations_under(plane);
      const bool is_diagonal = meets_any_at(min_diagonal, max_diagonal, candidate);
      DisjointSets orbits(static_cast<std::size_t>(parts_.count()));
      for (const Relation& relation : relations_) join(orbits, relation);
      const bool joins = std::any_of(relations.begin(), relations.end(), [&](const Relation& relation) {
        const bool first = std::any_of(relation.parts.begin(), relation.parts.end(),
                                       [&](int part) { return !has(part, RelationType::symmetry); });
        return relation.type == RelationType::symmetry && (is_diagonal ? first : join(orbits, relation));
      });
      if (!joins) continue;
      planes_.push_back(plane);
      append(relations);
    }
  }

  /// Relates the parts that a rotation of the whole moves in cycles: three skewed legs, the blades of a fan.
  /// A relation leads from each part of a cycle to the next, but for the last. Where a selected plane
  /// contains the axis, planes relate the parts: a square may become a rectangle.
  void add_cycles(const Symmetry& rotation) {
    if (std::any_of(planes_.begin(), planes_.end(), [&](const Symmetry& plane) {
          return std::abs(plane.axis.dot(rotation.axis)) < detail::nearly_across;
        }))
      return;
    std::vector<std::pair<int, double>> images(static_cast<std::size_t>(parts_.count()));
    tbb::parallel_for(0, parts_.count(), [&](int part) {
      images[static_cast<std::size_t>(part)] = counterpart(part, rotation);
    });
    DisjointSets orbits(static_cast<std::size_t>(parts_.count()));
    for (const Relation& relation : relations_) join(orbits, relation);
    std::vector<Relation> relations;
    for (int first = 0; first < parts_.count(); ++first) {
      std::vector<Relation> cycle;
      int part = first;
      do {
        const auto [next, residual] = images[static_cast<std::size_t>(part)];
        if (next < 0 || static_cast<int>(cycle.size()) == rotation.order) break;
        cycle.push_back(related({part, next}, rotation, residual));
        part = next;
      } while (part != first);
      if (part != first || cycle.size() < 2 || rotation.order % static_cast<int>(cycle.size()) != 0) continue;
      cycle.pop_back();
      if (std::none_of(cycle.begin(), cycle.end(), [&](const Relation& relation) {
            return orbits.root(static_cast<std::size_t>(relation.parts[0])) !=
                   orbits.root(static_cast<std::size_t>(relation.parts[1]));
          }))
        continue;
      for (const Relation& relation : cycle) join(orbits, relation);
      relations.insert(relations.end(), cycle.begin(), cycle.end());
    }
    append(relations);
  }

  /// Returns whether the cosine of the angle to a selected plane is between `least` and `most`.
  bool meets_any_at(double least, double most, const Symmetry& candidate) const {
    return std::any_of(planes_.begin(), planes_.end(), [&](const Symmetry& plane) {
      const double cosine = std::min(1.0, std::abs(plane.axis.dot(candidate.axis)));
      return least < cosine && cosine <= most;
    });
  }

  /// Returns whether the relation joins parts of different orbits.
  static bool join(DisjointSets& orbits, const Relation& relation) {
    const auto a = static_cast<std::size_t>(relation.parts.front()),
               b = static_cast<std::size_t>(relation.parts.back());
    const bool apart = orbits.root(a) != orbits.root(b);
    orbits.join(a, b);
    return apart;
  }

  /// Returns the reflections that map the part to itself.
  std::vector<Symmetry> own_reflections(int part) const {
    std::vector<Symmetry> planes;
    for (const std::size_t row : relations_of_[static_cast<std::size_t>(part)])
      if (relations_[row].type == RelationType::self_symmetry) planes.push_back(relations_[row].symmetry);
    return planes;
  }

  /// Returns the self-symmetries of a part without counterparts. Planes of its own are for shapes that have
  /// none: a part of a symmetric shape follows its neighbours, which would not follow its planes.
  std::vector<Relation> own_relations(int part) const {
    if (!parts_.part(part) || has(part, RelationType::symmetry)) return {};
    std::vector<Relation> relations = revolution(part);
    if (relations.empty() && planes_.empty()) relations = own_planes(part);
    return relations;
  }

  /// Returns the relations of a part of revolution, or none. A bar whose ends the shape exchanges by a
  /// reflection gets none: its primitive represents its roundness.
  std::vector<Relation> revolution(int part) const {
    const SymmetrySurface& surface = *parts_.part(part);
    const std::vector<Symmetry> axes = detail::revolutions(surface, options_, detail::Roundness::tolerant);
    if (axes.empty()) return {};
    const std::vector<Symmetry> own = own_reflections(part);
    Symmetry axis = detail::to_model(surface, axes.front());
    std::vector<Symmetry> through;
    for (const Symmetry& plane : own) {
      if (std::abs(plane.axis.dot(axis.axis)) > detail::nearly_across) continue;
      axis.axis = (axis.axis - plane.axis * plane.axis.dot(axis.axis)).normalized();
      axis.point -= plane.axis * plane.axis.dot(axis.point - plane.point);
      through.push_back(plane);
    }
    for (const Symmetry& plane : own)
      if (std::abs(plane.axis.dot(axis.axis)) > tolerance::parallel) {
        if (through.size() < 2) return {};
        axis.axis = plane.axis;
      }

    std::vector<Symmetry> planes;
    if (through.empty())
      planes = detail::planes_through(axis);
    else if (through.size() == 1)
      planes = {
          {SymmetryKind::reflection, axis.point, axis.axis.cross(through.front().axis).normalized(), 2}};
    planes.push_back(axis);
    std::vector<Relation> relations;
    for (const Symmetry& symmetry : planes)
      relations.push_back(related({part}, symmetry, parts_.match(part, part, symmetry).value_or(0)));
    return relations;
  }

  /// Returns the reflections in planes through the centre of a part and along its own box.
  std::vector<Relation> own_planes(int part) const {
    const SymmetrySurface& surface = *parts_.part(part);
    std::vector<Symmetry> planes;
    for (int k = 0; k < 3; ++k) {
      const Symmetry start{SymmetryKind::reflection, Eigen::Vector3d::Zero(), surface.box.axes.col(k), 2};
      const Symmetry plane =
          detail::refine_symmetry(surface, start, detail::counterpart_reach(surface, options_));
      if (detail::verify(surface, plane, options_, detail::Effort::dense).holds)
        planes.push_back(detail::to_model(surface, plane));
    }
    std::vector<Relation> relations;
    for (const Symmetry& plane : detail::canonical_reflections(surface, {&surface}, planes))
      if (const auto residual = parts_.match(part, part, plane))
        relations.push_back(related({part}, plane, *residual));
    return relations;
  }

  SymmetryOptions options_;
  PartSurfaces parts_;
  std::vector<Symmetry> candidates_, rotations_, planes_;  ///< model units
  std::vector<Relation> relations_;
  std::vector<std::vector<std::size_t>> relations_of_;  ///< rows per part, ascending
};

}  // namespace

std::vector<Relation> symmetry_relations(const Shape& shape, const std::vector<FoundSymmetry>& symmetries,
                                         const SymmetryOptions& options) {
  validate(shape);
  detail::validate(options);
  return PartSymmetry(shape, symmetries, options).run();
}

}  // namespace stackabilization
