#include "stackabilization/improvement/energy.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "improvement/design/design_match.h"
#include "improvement/design/primitive_axis.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/boxes.h"
#include "structure/model/correspondence.h"

namespace stackabilization {

namespace {

/// A pair of symmetric parts, for Eq. 10.
struct SymmetricPair {
  std::size_t a = 0, b = 0;
  Eigen::Isometry3d map;
  std::vector<int> counterpart;  ///< per control point of a, the corresponding one of b
  double at_rest = 0;            ///< violation of the symmetry at rest, model units
};

/// Returns delta(T(a), b): the sum of distances between corresponding control points, model units.
double miss(const SymmetricPair& pair, const std::vector<Primitive>& primitives) {
  const Points from = control_points(primitives[pair.a]), to = control_points(primitives[pair.b]);
  double sum = 0;
  for (Eigen::Index i = 0; i < from.rows(); ++i) {
    const Eigen::Vector3d image = pair.map * from.row(i).transpose();
    sum += (image - to.row(pair.counterpart[static_cast<std::size_t>(i)]).transpose()).norm();
  }
  return sum;
}

std::vector<SymmetricPair> symmetric_pairs(const Structure& structure,
                                           const std::vector<Primitive>& primitives) {
  std::vector<SymmetricPair> pairs;
  for (const Relation& relation : structure.relations) {
    if (relation.type != RelationType::symmetry) continue;
    SymmetricPair pair;
    pair.a = static_cast<std::size_t>(relation.parts[0]);
    pair.b = static_cast<std::size_t>(relation.parts[1]);
    pair.map = isometry_of(relation.symmetry);
    pair.counterpart = control_correspondence(primitives[pair.a], primitives[pair.b], pair.map);
    if (pair.counterpart.empty())
      throw InputError("the primitives of '" + structure.parts[pair.a].name + "' and '" +
                       structure.parts[pair.b].name +
                       "' cannot be symmetric: they differ in kind or in their number of cross-sections");
    pair.at_rest = miss(pair, primitives);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

/// Returns the rows of the vertices that triangles use.
std::vector<Eigen::Index> used_rows(const Shape& shape) {
  std::vector<char> used(static_cast<std::size_t>(shape.vertex_count()), 0);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) used[static_cast<std::size_t>(shape.triangles(t, k))] = 1;
  std::vector<Eigen::Index> rows;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v] != 0) rows.push_back(static_cast<Eigen::Index>(v));
  return rows;
}

Eigen::Matrix3d axes_of_box(const Shape& shape, BoxModel boxes) {
  if (boxes == BoxModel::frame) return Eigen::Matrix3d::Identity();
  return minimal_oriented_box(HullSupport(shape)).axes;
}

const StructuredShape& checked_rest(const StructuredShape& rest) {
  validate(rest);
  if (!(rest.structure.diagonal > 0) || !std::isfinite(rest.structure.diagonal))
    throw InputError("the diagonal of the structure must be positive");
  return rest;
}

double checked_alpha(double alpha) {
  if (!(alpha >= 0 && alpha <= 1)) throw UsageError("alpha must be a number from 0 to 1");
  return alpha;
}

/// Returns the extents of the vertices `rows` along each column of `axes`.
Eigen::Vector3d extents(const Points& vertices, const std::vector<Eigen::Index>& rows,
                        const Eigen::Matrix3d& axes) {
  Eigen::RowVector3d low = vertices.row(rows.front()) * axes, high = low;
  for (const Eigen::Index row : rows) {
    const Eigen::RowVector3d local = vertices.row(row) * axes;
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  }
  return (high - low).transpose();
}

}  // namespace

struct EnergyMeter::Rest {
  Rest(const StructuredShape& rest, const Eigen::Matrix3d& main_axes)
      : diagonal(rest.structure.diagonal),
        primitives(detail::primitives_of(rest.structure)),
        vertex_count(rest.shape.vertex_count()),
        rows(used_rows(rest.shape)),
        axes(main_axes),
        sides(extents(rest.shape.vertices, rows, axes)),
        pairs(symmetric_pairs(rest.structure, primitives)) {
    for (const Primitive& primitive : primitives) {
      volumes.push_back(volume(primitive));
      long_axes.push_back(detail::axis_of(primitive));
      curves.push_back(detail::axis_curve(primitive, long_axes.back()));
      volume_sum += volumes.back();
    }
    for (std::size_t j = 0; j < curves.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) {
        distances.push_back(detail::curve_distance(curves[i], curves[j]));
        distance_sum += distances.back();
      }
    const double cube = diagonal * diagonal * diagonal;
    if (!(volume_sum > tolerance::relative * cube)) volume_sum = cube;
    if (!(distance_sum > tolerance::relative * diagonal)) distance_sum = diagonal;
  }

  Eigen::VectorXd volume_changes(const std::vector<Primitive>& now) const {
    Eigen::VectorXd changes(static_cast<Eigen::Index>(now.size()));
    for (std::size_t i = 0; i < now.size(); ++i)
      changes[static_cast<Eigen::Index>(i)] = (volume(now[i]) - volumes[i]) / volume_sum;
    return changes;
  }

  Eigen::VectorXd proximity_changes(const std::vector<Primitive>& now) const {
    std::vector<Points> moved;
    for (std::size_t i = 0; i < now.size(); ++i) moved.push_back(detail::axis_curve(now[i], long_axes[i]));
    Eigen::VectorXd changes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(distances.size()));
    std::size_t pair = 0;
    for (std::size_t j = 0; j < now.size(); ++j)
      for (std::size_t i = 0; i < j; ++i, ++pair)
        if (moved[i] != curves[i] || moved[j] != curves[j])
          changes[static_cast<Eigen::Index>(pair)] =
              (detail::curve_distance(moved[i], moved[j]) - distances[pair]) / distance_sum;
    return changes;
  }

  Eigen::VectorXd box_changes(const Points& vertices) const {
    return (extents(vertices, rows, axes) - sides) / sides.sum();
  }

  double symmetry_change(const std::vector<Primitive>& now) const {
    if (pairs.empty()) return 0;
    double sum = 0;
    for (const SymmetricPair& pair : pairs) sum += std::max(0.0, miss(pair, now) - pair.at_rest);
    return sum / static_cast<double>(pairs.size()) / diagonal;
  }

  double diagonal;
  std::vector<Primitive> primitives;
  Eigen::Index vertex_count;
  std::vector<Eigen::Index> rows;
  Eigen::Matrix3d axes;
  Eigen::Vector3d sides;
  std::vector<SymmetricPair> pairs;
  /// `distances`: of pairs i < j, ordered by j, then i.
  std::vector<double> volumes, distances;
  std::vector<int> long_axes;
  std::vector<Points> curves;
  double volume_sum = 0, distance_sum = 0;
};

Distortion DistortionChanges::distortion() const {
  return {volume.cwiseAbs().sum(), proximity.cwiseAbs().sum(), box.cwiseAbs().sum(), symmetry};
}

double axis_distance(const Primitive& a, const Primitive& b) {
  return detail::curve_distance(detail::axis_curve(a, detail::axis_of(a)),
                                detail::axis_curve(b, detail::axis_of(b)));
}

EnergyMeter::EnergyMeter(const StructuredShape& rest, BoxModel boxes, double alpha)
    : EnergyMeter(rest, axes_of_box(checked_rest(rest).shape, boxes), alpha) {}

EnergyMeter::EnergyMeter(const StructuredShape& rest, const Eigen::Matrix3d& main_axes, double alpha)
    : alpha_(checked_alpha(alpha)), rest_(std::make_shared<const Rest>(checked_rest(rest), main_axes)) {}

EnergyMeter EnergyMeter::with_alpha(double alpha) const {
  EnergyMeter result = *this;
  result.alpha_ = checked_alpha(alpha);
  return result;
}

Distortion EnergyMeter::distortion(const Design& design) const {
  return changes(design).distortion();
}

DistortionChanges EnergyMeter::changes(const Design& design) const {
  detail::require_match(design, rest_->primitives, rest_->vertex_count);
  return {rest_->volume_changes(design.primitives), rest_->proximity_changes(design.primitives),
          rest_->box_changes(design.shape.vertices), rest_->symmetry_change(design.primitives)};
}

Energy EnergyMeter::energy(const Design& design, double gain) const {
  Energy energy;
  energy.distortion = distortion(design);
  energy.gain = gain;
  energy.value = alpha_ * energy.distortion.total() - (1 - alpha_) * gain;
  return energy;
}

}  // namespace stackabilization
