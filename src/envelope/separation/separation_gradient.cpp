#include "stackabilization/envelope/separation_gradient.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "envelope/separation/common_frame.h"
#include "envelope/separation/exact_pair.h"
#include "envelope/separation/touching_pairs.h"
#include "mesh/barycentric.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/envelope/tolerances.h"

namespace stackabilization {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Pairs of triangles that may touch are examined one by one, up to this number or the limit of touches.
constexpr std::int64_t min_candidates = std::int64_t{1} << 12;
constexpr const char* not_blocked = "shapes that pass each other have no separation, and no gradient";

/// Two triangles and the points of them that touch after the lift; corners are rows.
struct Touch {
  Matrix3d upper, lower;
  Vector3d upper_point, lower_point;
};

Matrix3d corners_of(const Shape& shape, Eigen::Index triangle) {
  Matrix3d corners;
  for (int i = 0; i < 3; ++i) corners.row(i) = shape.corner(triangle, i).transpose();
  return corners;
}

Vector3d edge(const Matrix3d& corners, int i) {
  return (corners.row((i + 1) % 3) - corners.row(i)).transpose();
}

double edge_length(const Matrix3d& corners) {
  return std::max({edge(corners, 0).norm(), edge(corners, 1).norm(), edge(corners, 2).norm()});
}

bool is_degenerate(const Matrix3d& corners) {
  return edge(corners, 0).cross(edge(corners, 1)).isZero(0);
}

/// Normals that a plane between two triangles can have: of either one, or along an edge of each.
std::vector<Vector3d> possible_normals(const Touch& touch) {
  std::vector<Vector3d> normals = {edge(touch.upper, 0).cross(edge(touch.upper, 1)),
                                   edge(touch.lower, 0).cross(edge(touch.lower, 1))};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) normals.push_back(edge(touch.upper, i).cross(edge(touch.lower, j)));
  return normals;
}

/// How far the triangles reach through the plane through the touching points, model units.
double reach_through(const Touch& touch, const Vector3d& unit_normal) {
  const double above = (touch.upper * unit_normal).maxCoeff() - touch.upper_point.dot(unit_normal);
  const double below = touch.lower_point.dot(unit_normal) - (touch.lower * unit_normal).minCoeff();
  return std::max(above, below);
}

/// The normal n of the plane between the triangles, n.r = 1.
Vector3d plane_between(const Touch& touch, const Vector3d& r) {
  Vector3d best = Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& candidate : possible_normals(touch)) {
    const Vector3d normal = candidate / candidate.dot(r);
    if (!normal.allFinite()) continue;
    const double reach = reach_through(touch, normal.normalized());
    if (reach >= least) continue;
    least = reach;
    best = normal;
  }
  return best;
}

/// What rounding makes of a plane that touches both triangles, model units.
double reach_of_rounding(const Touch& touch) {
  const double size = std::max((touch.upper.colwise().maxCoeff() - touch.upper.colwise().minCoeff()).norm(),
                               (touch.lower.colwise().maxCoeff() - touch.lower.colwise().minCoeff()).norm());
  const double coordinate = std::max(touch.upper.cwiseAbs().maxCoeff(), touch.lower.cwiseAbs().maxCoeff());
  return tolerance::relative * size + tolerance::rounding * coordinate;
}

/// The normals n, n.r = 1, of all planes between the triangles that no other planes lie around: corners of
/// the polygon of all of them.
std::vector<Vector3d> planes_between(const Touch& touch, const Vector3d& r) {
  std::vector<Vector3d> normals = {plane_between(touch, r)};
  if (normals.front().isZero(0)) return {};
  const double allowed = reach_of_rounding(touch);
  const double size = edge_length(touch.upper) * edge_length(touch.lower);
  for (const Vector3d& candidate : possible_normals(touch)) {
    const double across = candidate.dot(r);
    if (candidate.norm() <= tolerance::relative * size ||
        std::abs(across) <= tolerance::relative * candidate.norm() * r.norm())
      continue;
    const Vector3d normal = candidate / across;
    const auto is_same = [&](const Vector3d& known) {
      return known.isApprox(normal, tolerance::same_normal);
    };
    if (reach_through(touch, normal.normalized()) <= allowed &&
        std::none_of(normals.begin(), normals.end(), is_same))
      normals.push_back(normal);
  }
  return normals;
}

Matrix3d corners_of(const SeparationTree::Data& tree, std::int32_t at) {
  const TreeTriangle triangle = tree.in_file_axes(at);
  Matrix3d corners;
  for (int c = 0; c < 3; ++c)
    corners.row(c) = Eigen::RowVector3d(triangle.corners[static_cast<std::size_t>(c)].data());
  return corners;
}

/// Collects the touches of a separation.
class TouchCollector {
 public:
  TouchCollector(const GradientQuery& query, const GradientOptions& options)
      : query_(query),
        options_(options),
        frame_(query.below, query.above),
        projection_(query.direction, std::max(frame_.below().magnitude, frame_.above().magnitude),
                    options.semantics) {}

  SeparationGradients run() {
    const Rational height =
        query_.separation.value * Rational(std::abs(projection_.shear.r[projection_.shear.k]));
    const double floor = std::nextafter(height.to_double(), -detail::infinity);
    const detail::ContactPairs found = detail::touching_pairs(
        frame_.below(), frame_.above(), projection_, floor, std::max(options_.limit, min_candidates));
    result_.complete = found.complete;
    for (const detail::ContactPair& pair : found.pairs) {
      if (limit_reached_) break;
      add(pair);
    }
    return std::move(result_);
  }

 private:
  void add(const detail::ContactPair& pair) {
    const auto maximum =
        detail::exact_maximum_with_points(frame_.below().triangles[static_cast<std::size_t>(pair.upper_at)],
                                          frame_.above().triangles[static_cast<std::size_t>(pair.lower_at)],
                                          projection_.shear, options_.semantics);
    if (!maximum || maximum->value != query_.separation.value) return;
    Touch touch{corners_of(frame_.below(), pair.upper_at), corners_of(frame_.above(), pair.lower_at), {}, {}};
    if (is_degenerate(touch.upper) || is_degenerate(touch.lower)) {
      result_.complete = false;
      return;
    }
    for (const detail::ExactPoints& points : maximum->points) {
      touch.upper_point = points.upper + origin(frame_.below());
      touch.lower_point = points.lower + origin(frame_.above());
      add(pair, touch);
    }
  }

  void add(const detail::ContactPair& pair, const Touch& touch) {
    const Vector3d& r = query_.direction.vector();
    const std::vector<Vector3d> normals = planes_between(touch, r);
    if (normals.empty()) result_.complete = false;
    if (normals.size() > 1) result_.one_plane_each = false;
    const double length = query_.direction.length(), value = query_.separation.value.to_double();
    for (const Vector3d& normal : normals) {
      if (std::ssize(result_.touches) == options_.limit) {
        limit_reached_ = true;
        result_.complete = false;
        return;
      }
      result_.touches.push_back({pair.upper, pair.lower,
                                 detail::barycentric_weights(touch.upper, touch.upper_point),
                                 detail::barycentric_weights(touch.lower, touch.lower_point), length * normal,
                                 value * (r / length - length * normal)});
    }
  }

  static Vector3d origin(const SeparationTree::Data& tree) { return Vector3d(tree.origin.data()); }

  const GradientQuery& query_;
  const GradientOptions& options_;
  detail::CommonFrame frame_;
  detail::Projection projection_;
  SeparationGradients result_;
  bool limit_reached_ = false;
};

}  // namespace

SeparationGradient separation_gradient(const Shape& below, const Shape& above, const Direction& direction,
                                       const Separation& separation) {
  if (!separation.blocked) throw UsageError(not_blocked);
  const Witness& witness = separation.witness;
  const Touch touch{corners_of(below, witness.upper_triangle), corners_of(above, witness.lower_triangle),
                    witness.upper_point, witness.lower_point};
  if (is_degenerate(touch.upper) || is_degenerate(touch.lower))
    throw UsageError("a triangle without area attains the separation, which has no gradient there");
  const Vector3d weights_upper = detail::barycentric_weights(touch.upper, touch.upper_point);
  const Vector3d weights_lower = detail::barycentric_weights(touch.lower, touch.lower_point);
  const Vector3d& r = direction.vector();
  const double length = direction.length();
  const Vector3d normal = plane_between(touch, r);
  const double value = separation.value.to_double();
  return {length * weights_upper * normal.transpose(), -length * weights_lower * normal.transpose(),
          value * (r / length - length * normal)};
}

SeparationGradients separation_gradients(const GradientQuery& query, const GradientOptions& options) {
  if (!query.separation.blocked) throw UsageError(not_blocked);
  if (options.limit < 1) throw UsageError("the limit of the touches of a separation must be at least 1");
  return TouchCollector(query, options).run();
}

}  // namespace stackabilization
