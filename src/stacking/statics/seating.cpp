#include "stackabilization/stacking/seating.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/angles.h"
#include "core/bounding_diagonal.h"
#include "mesh/surface_index.h"
#include "mesh/surface_moments.h"
#include "mesh/triangle_tree.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/tolerances.h"
#include "stacking/draft/solid_sides.h"
#include "stacking/statics/border_margin.h"
#include "stacking/statics/contact_forces.h"
#include "stacking/statics/contact_holds.h"
#include "stacking/statics/copy_joint.h"
#include "stacking/statics/mass_centre.h"

namespace stackabilization {

namespace {

/// Slope of a wall that is upright: higher than any other.
constexpr double max_slope = 1e6;

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

/// Returns the least slope over all sides at which contacts lift a copy that is shifted; z is up.
double centring_slope(const std::vector<detail::Hold>& holds) {
  std::vector<Eigen::Vector2d> slopes;
  for (const detail::Hold& hold : holds)
    slopes.emplace_back(-hold.normal.head<2>() / std::max(hold.normal.z(), 1 / max_slope));
  return slopes.empty() ? 0 : detail::border_margin(slopes, tolerance::relative).distance;
}

/// Looks for walls of a copy that are close to walls of the one below.
class TightWallSearch {
 public:
  TightWallSearch(const Shape& shape, const Direction& direction, double lift, const SeatingOptions& options)
      : shape_(shape),
        axis_(direction.unit()),
        lift_(lift * axis_),
        options_(options),
        diagonal_(bounding_diagonal(shape)),
        sides_(shape, tolerance::beside_surface * diagonal_),
        tree_(shape, rows_with_area(shape)) {}

  /// Appends a hold per sample that is close to a wall.
  std::vector<TightWalls> run(std::vector<detail::ContactHold>& holds) const;

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

  static std::vector<std::int32_t> rows_with_area(const Shape& shape) {
    std::vector<std::int32_t> rows;
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
      if (detail::has_area(shape, t)) rows.push_back(static_cast<std::int32_t>(t));
    return rows;
  }
  bool is_steep(const Eigen::Vector3d& normal) const {
    return std::tan(detail::angle_to_surface(normal, axis_)) < options_.friction;
  }

  const Shape& shape_;
  Eigen::Vector3d axis_, lift_;
  const SeatingOptions& options_;
  double diagonal_;
  detail::SolidSides sides_;
  detail::TriangleTree<Kernel> tree_;
};

std::vector<TightWalls> TightWallSearch::run(std::vector<detail::ContactHold>& holds) const {
  const SurfaceSamples samples = surface_samples(shape_, options_.samples);
  const double share = detail::SurfaceMoments(shape_, shape_.corner(0, 0)).area() /
                       static_cast<double>(samples.points.rows()),
               reach = tolerance::relative * diagonal_,
               side_gap = options_.side_gap.value_or(tolerance::side_gap * diagonal_);
  std::map<std::pair<int, int>, TightWalls> walls;
  for (Eigen::Index k = 0; k < samples.points.rows(); ++k) {
    const Eigen::Vector3d normal = samples.normals.row(k).transpose(),
                          point = samples.points.row(k).transpose();
    if (!is_steep(normal)) continue;
    const Eigen::Vector3d across = (normal - normal.dot(axis_) * axis_).normalized();
    for (const double side : {1.0, -1.0}) {
      // A copy that can be lifted has no wall above the one below.
      if (-side * normal.dot(axis_) < -tolerance::wall_slope) continue;
      const Eigen::Vector3d outwards = side * across, start = point + lift_ - reach * outwards;
      const auto hit = tree_.first_hit(start, outwards);
      if (!hit) continue;
      const double gap = std::max(0.0, (hit->point - start).dot(outwards) - reach);
      const Eigen::Vector3d facing = detail::unit_normal(shape_, hit->triangle);
      if (gap > side_gap || !is_steep(facing)) continue;
      if (sides_.contains(point + tolerance::beside_surface * diagonal_ * outwards)) continue;
      const int
          upper = shape_.triangle_part[static_cast<std::size_t>(hit->triangle)],
          lower =
              shape_.triangle_part[static_cast<std::size_t>(samples.triangles[static_cast<std::size_t>(k)])];
      const double draft =
          degrees(std::min(detail::angle_to_surface(normal, axis_), detail::angle_to_surface(facing, axis_)));
      auto [wall, added] = walls.try_emplace({upper, lower}, TightWalls{upper, lower, gap, draft, 0});
      wall->second.gap = std::min(wall->second.gap, gap);
      wall->second.draft_degrees = std::min(wall->second.draft_degrees, draft);
      wall->second.area += share;
      holds.push_back({{hit->point, -side * normal}, upper, lower});
    }
  }
  std::vector<TightWalls> found;
  for (const auto& [parts, wall] : walls) found.push_back(wall);
  std::stable_sort(found.begin(), found.end(), [](const TightWalls& a, const TightWalls& b) {
    return a.draft_degrees < b.draft_degrees;
  });
  return found;
}

void check(const Direction& direction, const SeatingOptions& options) {
  detail::check_statics(options.band, options.friction, options.up, direction);
  if (!(std::isfinite(options.side_gap.value_or(0)) && options.side_gap.value_or(0) >= 0))
    throw UsageError("the gap of tight walls must be a finite length of at least 0");
  if (options.samples < 1) throw UsageError("tight walls are looked for with at least one sample");
}

}  // namespace

Seating seating(const Shape& shape, const Direction& direction, const SeatingOptions& options) {
  check(direction, options);
  validate(shape);
  const Eigen::Vector3d mass = detail::mass_centre(shape).centre;
  const detail::CopyJoint joint = detail::copy_joint(shape, direction, options.semantics, options.band);
  std::vector<detail::ContactHold> contacts = detail::contact_holds(shape, direction, joint.regions);
  const Frame frame = frame_of(options.up ? Direction(*options.up) : direction);
  const Eigen::Vector3d axis = frame.to_local(direction.unit()),
                        above = frame.to_local(mass) + joint.lift * axis;

  Seating result;
  const std::vector<detail::Hold> holds = detail::holds_in(frame, contacts);
  result.centring_slope = centring_slope(holds);
  for (const detail::Hold& hold : holds)
    result.draft_degrees =
        std::min(result.draft_degrees, degrees(detail::angle_to_surface(hold.normal, axis)));
  const auto grip_of = [&](const std::vector<detail::ContactHold>& some) {
    return detail::ContactForces(detail::holds_in(frame, some), options.friction, above).grip(axis);
  };
  contacts = detail::spread_out(contacts, detail::hold_count);
  const auto grip = grip_of(contacts);
  const double by_contacts = grip ? std::max(grip->resisted, tolerance::friction) : tolerance::friction;
  if (by_contacts > tolerance::friction) {
    result.pull_off = grip->resisted / grip->press;
    Eigen::Index strongest = 0;
    grip->normal_forces.maxCoeff(&strongest);
    result.upper_part = contacts[static_cast<std::size_t>(strongest)].upper_part;
    result.lower_part = contacts[static_cast<std::size_t>(strongest)].lower_part;
  }
  std::vector<detail::ContactHold> beside;
  result.tight = TightWallSearch(shape, direction, joint.lift, options).run(beside);
  if (result.tight.empty()) return result;
  beside = detail::spread_out(beside, detail::hold_count);
  contacts.insert(contacts.end(), beside.begin(), beside.end());
  const auto with_walls = grip_of(contacts);
  if (with_walls && with_walls->resisted > by_contacts + tolerance::friction)
    result.walls_pull_off = with_walls->resisted / with_walls->press;
  return result;
}

}  // namespace stackabilization
