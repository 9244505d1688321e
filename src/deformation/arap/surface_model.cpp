#include "stackabilization/deformation/surface_model.h"

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/index.h"
#include "deformation/arap/stitching_edges.h"
#include "deformation/arap/surface_handles.h"
#include "deformation/model/vertex_constraints.h"
#include "mesh/barycentric.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

using detail::at;

using Kernel = CGAL::Simple_cartesian<double>;
using NeighbourSearch = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;

Kernel::Point_3 to_cgal(const Eigen::RowVector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// Affine map of an operation: its linear part, the rotation in it, and its translation.
struct LinearMap {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity(), turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d by = Eigen::Vector3d::Zero();
};

/// Returns the map of an edit. Sections scale across `axis`.
LinearMap linear_map(const Edit& edit, const Eigen::Vector3d& axis) {
  LinearMap map;
  if (const auto* move = std::get_if<Move>(&edit.operation)) {
    map.by = move->by;
  } else if (const auto* rotate = std::get_if<Rotate>(&edit.operation)) {
    map.linear = map.turn = Eigen::AngleAxisd(rotate->radians, rotate->axis.normalized()).toRotationMatrix();
  } else {
    const Scale& scale = std::get<Scale>(edit.operation);
    const Eigen::Matrix3d all = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d scaled = all;
    if (scale.along) {
      const Eigen::Vector3d along = scale.along->normalized();
      scaled = along * along.transpose();
    } else if (edit.handle.kind == HandleKind::section) {
      scaled = all - axis * axis.transpose();
    }
    map.linear = all + (scale.factor - 1) * scaled;
  }
  return map;
}

/// Positions of the welded vertices (places) after a sequence of edits.
struct Targets {
  Points background;   ///< positions of all places after the edits of the shape alone
  RotatedPoints held;  ///< positions of held places; rotations are relative to `background`
  std::vector<bool> is_held;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< rotation of the background
  bool whole = false;                                  ///< whether an edit of the shape occurred
};

void transform(Points& points, const detail::HeldSurface& at, const Eigen::Vector3d& centre,
               const LinearMap& map) {
  const Eigen::Matrix3d change = map.linear - Eigen::Matrix3d::Identity();
  for (const std::int32_t p : at.places) {
    const Eigen::Vector3d arm = points.row(p).transpose() - centre;
    points.row(p) += (change * arm + map.by).transpose();
  }
}

void apply(Targets& targets, const Edit& edit, const detail::HeldSurface& held, const Eigen::Vector3d& axis) {
  const Eigen::Matrix3d turned = targets.held.rotations[at(held.places.front())] * targets.turn;
  const LinearMap map = linear_map(edit, turned * axis);
  const Eigen::Vector3d centre = targets.held.points(held.places, Eigen::all).transpose() * held.weights;
  transform(targets.held.points, held, centre, map);
  if (edit.handle.kind == HandleKind::shape) {
    transform(targets.background, held, centre, map);
    for (Eigen::Matrix3d& rotation : targets.held.rotations)
      rotation = map.turn * rotation * map.turn.transpose();
    targets.turn = map.turn * targets.turn;
    targets.whole = true;
    return;
  }
  for (const std::int32_t p : held.places) {
    targets.is_held[at(p)] = true;
    targets.held.rotations[at(p)] = map.turn * targets.held.rotations[at(p)];
  }
}

/// Returns whether the squares of all coordinates are in the range of numbers.
bool in_range(const Points& points) {
  return (points.array().abs() <= tolerance::max_coordinate).all();
}

/// Rigid motion of the surface around a point at rest: a rotation about the point, then a translation.
struct RigidMotion {
  Eigen::Matrix3d turn;
  Eigen::Vector3d by;
};

RigidMotion motion_at(const Shape& rest, const SurfacePoint& point, const RotatedPoints& now) {
  const Eigen::Vector3d weights = detail::barycentric_weights(rest, point.triangle, point.point);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  RigidMotion motion{{}, Eigen::Vector3d::Zero()};
  for (int k = 0; k < 3; ++k) {
    const std::int32_t corner = rest.triangles(point.triangle, k);
    motion.by += weights(k) * (now.points.row(corner) - rest.vertices.row(corner)).transpose();
    turn += weights(k) * now.rotations[at(corner)];
  }
  motion.turn = Eigen::Quaterniond(turn).normalized().toRotationMatrix();
  return motion;
}

class SurfaceModel : public CarriedModel {
 public:
  SurfaceModel(StructuredShape structured, const SurfaceModelOptions& options)
      : CarriedModel(std::move(structured)),
        places_(detail::weld(shape())),
        handles_(shape(), places_, options),
        options_(options),
        diagonal_((places_.points.colwise().maxCoeff() - places_.points.colwise().minCoeff()).norm()),
        ties_(detail::stitching_edges(places_, RigidSurface(places_.points, places_.triangles).shells(),
                                      options.reach * diagonal_)),
        surface_(places_.points, places_.triangles, ties_) {}

  DeformationKind kind() const override { return DeformationKind::surface; }
  std::vector<Handle> handles() const override { return handles_.all(); }
  Eigen::Vector3d centre(const Handle& handle) const override {
    const detail::HeldSurface held = handles_.held(handle);
    return places_.points(held.places, Eigen::all).transpose() * held.weights;
  }

 private:
  MovedVertices moved(const std::vector<Edit>& edits,
                      const DeformationConstraints& constraints) const override;
  const Shape& shape() const { return rest().shape; }
  Targets targets(const std::vector<Edit>& edits) const;
  /// Holds the places that stay: fixed ones, and those beyond the influence of the held ones. Returns which
  /// places stay.
  std::vector<bool> hold_the_rest(Targets& targets, const std::vector<std::int32_t>& fixed) const;
  RotatedPoints solve(const Targets& targets, const std::vector<bool>& stays) const;
  void follow(RotatedPoints& now, const Targets& targets) const;
  std::vector<SurfacePoint> nearest_leaders(const Shape& leaders, const std::vector<bool>& led) const;
  std::vector<std::int32_t> vertices_at(const std::vector<bool>& places) const;

  detail::WeldedMesh places_;
  detail::SurfaceHandles handles_;
  SurfaceModelOptions options_;
  double diagonal_;
  std::vector<StitchingEdge> ties_;
  RigidSurface surface_;
};

Targets SurfaceModel::targets(const std::vector<Edit>& edits) const {
  const auto count = static_cast<std::size_t>(places_.points.rows());
  Targets targets{places_.points, {places_.points, {}}, std::vector<bool>(count)};
  targets.held.rotations.assign(count, Eigen::Matrix3d::Identity());
  for (const Edit& edit : edits) {
    validate(edit, diagonal_);
    if (std::holds_alternative<Taper>(edit.operation))
      throw UsageError("only controllers can taper the shape");
    if (std::holds_alternative<Lean>(edit.operation)) throw UsageError("only controllers can lean parts");
    const Scale* scale = std::get_if<Scale>(&edit.operation);
    if (scale && scale->along && edit.handle.kind != HandleKind::part &&
        edit.handle.kind != HandleKind::shape)
      throw UsageError("only parts and the shape can be scaled along one direction");
    apply(targets, edit, handles_.held(edit.handle), handles_.axis());
  }
  return targets;
}

std::vector<bool> SurfaceModel::hold_the_rest(Targets& targets,
                                              const std::vector<std::int32_t>& fixed) const {
  std::vector<bool> stays(targets.is_held.size());
  std::vector<Kernel::Point_3> handles;
  for (std::size_t p = 0; p < stays.size(); ++p)
    if (targets.is_held[p]) handles.push_back(to_cgal(places_.points.row(static_cast<Eigen::Index>(p))));
  const double reach = options_.influence * diagonal_;
  NeighbourSearch::Tree tree(handles.begin(), handles.end());
  for (std::size_t p = 0; p < stays.size(); ++p) {
    if (targets.is_held[p] || !std::isfinite(reach)) continue;
    const NeighbourSearch nearest(tree, to_cgal(places_.points.row(static_cast<Eigen::Index>(p))), 1);
    stays[p] = std::sqrt(nearest.begin()->second) > reach;
  }
  for (const std::int32_t vertex : fixed) stays[at(places_.of_vertex[at(vertex)])] = true;
  for (std::size_t p = 0; p < stays.size(); ++p)
    if (stays[p]) targets.is_held[p] = true;
  return stays;
}

RotatedPoints SurfaceModel::solve(const Targets& targets, const std::vector<bool>& stays) const {
  RotatedPoints start = targets.held;
  // Initial rotations: a shell without places that stay starts with the rotation of its handles, any other
  // shell from rest.
  const std::vector<std::int32_t>& shells = surface_.shells();
  std::vector<Eigen::Matrix3d> turn(shells.size(), Eigen::Matrix3d::Identity());
  std::vector<bool> known(shells.size());
  for (std::size_t p = 0; p < shells.size(); ++p) {
    const std::size_t shell = at(shells[p]);
    if (stays[p]) {
      turn[shell].setIdentity();
      known[shell] = true;
    } else if (targets.is_held[p] && !known[shell]) {
      turn[shell] = targets.held.rotations[p];
      known[shell] = true;
    }
  }
  for (std::size_t p = 0; p < shells.size(); ++p)
    if (!targets.is_held[p]) start.rotations[p] = turn[at(shells[p])];
  if (!targets.whole) return surface_.deformed(targets.is_held, std::move(start), options_.rigidity);
  return RigidSurface(targets.background, places_.triangles, ties_)
      .deformed(targets.is_held, std::move(start), options_.rigidity);
}

/// Returns, for each shell of `led`, the point of `leaders` nearest to any of its places. The shell follows
/// this point.
std::vector<SurfacePoint> SurfaceModel::nearest_leaders(const Shape& leaders,
                                                        const std::vector<bool>& led) const {
  const std::vector<std::int32_t>& shells = surface_.shells();
  const SurfaceIndex index(leaders);
  std::vector<SurfacePoint> nearest(led.size());
  for (std::size_t p = 0; p < shells.size(); ++p) {
    const std::size_t shell = at(shells[p]);
    if (!led[shell]) continue;
    const SurfacePoint point = index.nearest(leaders.vertices.row(static_cast<Eigen::Index>(p)).transpose());
    if (nearest[shell].triangle < 0 || point.distance < nearest[shell].distance) nearest[shell] = point;
  }
  return nearest;
}

void SurfaceModel::follow(RotatedPoints& now, const Targets& targets) const {
  const std::vector<std::int32_t>& shells = surface_.shells();
  std::vector<bool> led(at(*std::max_element(shells.begin(), shells.end())) + 1, true);  // by shell
  for (std::size_t p = 0; p < shells.size(); ++p)
    if (targets.is_held[p]) led[at(shells[p])] = false;
  if (std::find(led.begin(), led.end(), true) == led.end()) return;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index t = 0; t < places_.triangles.rows(); ++t)
    if (!led[at(shells[at(places_.triangles(t, 0))])] && places_.area(t) > 0) rows.push_back(t);
  if (rows.empty()) return;

  const Shape leaders{targets.background, places_.triangles(rows, Eigen::all), {}, {}};
  const std::vector<SurfacePoint> nearest = nearest_leaders(leaders, led);
  for (std::size_t p = 0; p < shells.size(); ++p) {
    const std::size_t shell = at(shells[p]);
    if (!led[shell]) continue;
    const RigidMotion motion = motion_at(leaders, nearest[shell], now);
    const auto row = static_cast<Eigen::Index>(p);
    const Eigen::Vector3d arm = leaders.vertices.row(row).transpose() - nearest[shell].point;
    now.points.row(row) += ((motion.turn - Eigen::Matrix3d::Identity()) * arm + motion.by).transpose();
  }
}

std::vector<std::int32_t> SurfaceModel::vertices_at(const std::vector<bool>& places) const {
  std::vector<std::int32_t> rows;
  for (std::size_t v = 0; v < places_.of_vertex.size(); ++v)
    if (places_.of_vertex[v] >= 0 && places[at(places_.of_vertex[v])])
      rows.push_back(static_cast<std::int32_t>(v));
  return rows;
}

MovedVertices SurfaceModel::moved(const std::vector<Edit>& edits,
                                  const DeformationConstraints& constraints) const {
  const std::vector<std::int32_t> fixed = fixed_vertices(shape(), constraints);
  Targets targets = this->targets(edits);
  Points places = targets.held.points;
  std::vector<bool> stays(targets.is_held.size());
  for (const std::int32_t vertex : fixed) stays[at(places_.of_vertex[at(vertex)])] = true;
  if (targets.held.points != targets.background && in_range(targets.held.points) &&
      in_range(targets.background)) {
    stays = hold_the_rest(targets, fixed);
    RotatedPoints now = solve(targets, stays);
    follow(now, targets);
    places = std::move(now.points);
  }
  Points vertices = shape().vertices;
  for (std::size_t v = 0; v < places_.of_vertex.size(); ++v)
    if (places_.of_vertex[v] >= 0)
      vertices.row(static_cast<Eigen::Index>(v)) = places.row(places_.of_vertex[v]);

  MovedVertices kept = constrain(shape(), vertices, constraints, fixed);
  if (constraints.keep_extent && !targets.whole) {
    MovedVertices local = constrain(shape(), vertices, constraints, vertices_at(stays));
    if (!local.refusal) kept = std::move(local);
  }
  return kept;
}

}  // namespace

std::unique_ptr<DeformationModel> surface_model(StructuredShape rest, const SurfaceModelOptions& options) {
  validate(rest.shape);
  return std::make_unique<SurfaceModel>(std::move(rest), options);
}

}  // namespace stackabilization
