#include "stackabilization/deformation/wire_analysis.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "core/bounding_diagonal.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

using PointColumns = Eigen::Matrix3Xd;

void check(const WireAnalysisOptions& options) {
  for (const double value :
       {options.form_tolerance, options.angle_tolerance, options.size_tolerance, options.distance_tolerance})
    if (!std::isfinite(value) || value < 0)
      throw UsageError("tolerances of wires must be finite and not negative");
  for (const Symmetry& s : options.symmetries)
    if (!s.point.allFinite() || !s.axis.allFinite() || s.order < 2)
      throw UsageError("a symmetry needs a finite point and axis, and an order of two at least");
}

PointColumns points_of(const Shape& shape, const FeatureCurve& curve) {
  PointColumns points(3, static_cast<Eigen::Index>(curve.vertices.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = shape.vertices.row(curve.vertices[static_cast<std::size_t>(i)]).transpose();
  return points;
}

/// Computes the length of the polygon and the centroid of its segments.
void measure(const PointColumns& points, Wire& wire) {
  const Eigen::Index n = points.cols();
  for (Eigen::Index i = 0; i + (wire.curve.closed ? 0 : 1) < n; ++i) {
    const Eigen::Vector3d a = points.col(i), b = points.col((i + 1) % n);
    const double length = (b - a).norm();
    wire.length += length;
    wire.centre += length * (a + b) / 2;
  }
  wire.centre /= wire.length;
}

bool take_as_straight(const PointColumns& points, double resolution, Wire& wire) {
  if (wire.curve.closed) return false;
  const Eigen::Vector3d a = points.leftCols<1>(), b = points.rightCols<1>();
  if (a == b) return false;
  const Eigen::Vector3d axis = (b - a).normalized();
  for (const auto& p : points.colwise())
    if (axis.cross(p - a).norm() > resolution) return false;
  wire.form = WireForm::straight;
  wire.axis = axis;
  wire.centre = (a + b) / 2;
  return true;
}

/// Fits a circle in the plane with normal `normal` (Kasa 1976: least squares of |p|^2 = 2 c.p + d). Returns
/// whether there are enough points and all of them are within `resolution` of the circle.
bool take_as_circle(const PointColumns& points, const Eigen::Vector3d& normal, double resolution,
                    Wire& wire) {
  const Eigen::Index n = points.cols();
  if (n < (wire.curve.closed ? 5 : 4)) return false;
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  Eigen::MatrixX3d matrix(n, 3);
  Eigen::VectorXd right(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d d = points.col(i) - wire.centre;
    const Eigen::Vector2d q(u.dot(d), v.dot(d));
    matrix.row(i) << 2 * q.x(), 2 * q.y(), wire.length;
    right(i) = q.squaredNorm();
  }
  const Eigen::Vector3d fit = matrix.colPivHouseholderQr().solve(right);
  const Eigen::Vector3d centre = wire.centre + u * fit.x() + v * fit.y();
  const double radius = (points.colwise() - centre).colwise().norm().mean();
  for (const auto& p : points.colwise())
    if (std::abs((p - centre).norm() - radius) > resolution) return false;
  wire.form = WireForm::circular;
  wire.centre = centre;
  wire.radius = radius;
  return true;
}

Wire described(const Shape& shape, const FeatureCurve& curve, const WireAnalysisOptions& options) {
  Wire wire;
  wire.curve = curve;
  const PointColumns points = points_of(shape, curve);
  measure(points, wire);
  const double resolution = options.form_tolerance * wire.length;
  if (take_as_straight(points, resolution, wire)) return wire;
  const PointColumns centred = points.colwise() - points.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centred * centred.transpose());
  const Eigen::Vector3d normal = axes.eigenvectors().col(0);
  if ((normal.transpose() * centred).cwiseAbs().maxCoeff() > resolution) return wire;
  wire.axis = normal;
  if (!take_as_circle(points, normal, resolution, wire)) wire.form = WireForm::planar;
  return wire;
}

/// Finds the relations between wires.
class Relations {
 public:
  Relations(const Shape& shape, const WireAnalysisOptions& options, WireStructure& structure)
      : shape_(shape),
        options_(options),
        structure_(structure),
        sine_(std::sin(options.angle_tolerance * std::numbers::pi / 180)),
        distance_(options.distance_tolerance * bounding_diagonal(shape)) {
    for (const Wire& wire : structure.wires) points_.push_back(points_of(shape, wire.curve));
  }

  void find() {
    find_parallel();
    find_orthogonal();
    find_congruent();
    find_junctions();
    find_planes();
    find_symmetric();
  }

 private:
  int count() const { return static_cast<int>(structure_.wires.size()); }
  const Wire& wire(int k) const { return structure_.wires[static_cast<std::size_t>(k)]; }
  const PointColumns& points(int k) const { return points_[static_cast<std::size_t>(k)]; }
  const Wire& first_of(const std::vector<int>& group) const { return wire(group.front()); }

  /// Puts wire k into the first group whose first member `agrees`, or into a new one.
  template <typename Agrees>
  static void insert(std::vector<std::vector<int>>& groups, int k, const Agrees& agrees) {
    const auto it =
        std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return agrees(g.front()); });
    if (it == groups.end())
      groups.push_back({k});
    else
      it->push_back(k);
  }

  void find_parallel() {
    for (int k = 0; k < count(); ++k)
      if (wire(k).form == WireForm::straight)
        insert(structure_.parallel, k,
               [&](int other) { return wire(k).axis.cross(wire(other).axis).norm() <= sine_; });
  }

  void find_orthogonal() {
    const auto& classes = structure_.parallel;
    for (std::size_t a = 0; a < classes.size(); ++a)
      for (std::size_t b = a + 1; b < classes.size(); ++b)
        if (std::abs(first_of(classes[a]).axis.dot(first_of(classes[b]).axis)) <= sine_)
          structure_.orthogonal.emplace_back(static_cast<int>(a), static_cast<int>(b));
  }

  bool equal(double a, double b) const { return std::abs(a - b) <= options_.size_tolerance * std::max(a, b); }

  void find_congruent() {
    std::vector<std::vector<int>> groups;
    for (const auto& parallel : structure_.parallel) {
      std::vector<std::vector<int>> lengths;
      for (const int k : parallel)
        insert(lengths, k, [&](int other) { return equal(wire(k).length, wire(other).length); });
      groups.insert(groups.end(), lengths.begin(), lengths.end());
    }
    std::vector<std::vector<int>> circles;
    for (int k = 0; k < count(); ++k)
      if (wire(k).form == WireForm::circular)
        insert(circles, k, [&](int other) {
          return wire(k).curve.closed == wire(other).curve.closed &&
                 equal(wire(k).radius, wire(other).radius) && equal(wire(k).length, wire(other).length);
        });
    groups.insert(groups.end(), circles.begin(), circles.end());
    for (auto& group : groups)
      if (group.size() > 1) structure_.congruent.push_back(std::move(group));
    std::sort(structure_.congruent.begin(), structure_.congruent.end());
  }

  void find_junctions() {
    std::map<std::int32_t, std::vector<int>> wires_at;
    for (int k = 0; k < count(); ++k) {
      const auto& vertices = wire(k).curve.vertices;
      wires_at[vertices.front()].push_back(k);
      if (!wire(k).curve.closed) wires_at[vertices.back()].push_back(k);
    }
    for (auto& [vertex, wires] : wires_at) {
      wires.erase(std::unique(wires.begin(), wires.end()), wires.end());
      if (wires.size() > 1) structure_.junctions.push_back({vertex, wires});
    }
  }

  bool in_plane(int k, const Eigen::Vector3d& normal, double offset) const {
    return ((normal.transpose() * points(k)).array() - offset).abs().maxCoeff() <= distance_;
  }

  void add_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
    WirePlane plane{normal, normal.dot(point), {}};
    for (const WirePlane& known : structure_.planes) {
      const double sign = known.normal.dot(normal) < 0 ? -1 : 1;
      if (known.normal.cross(normal).norm() <= sine_ &&
          std::abs(sign * known.normal.dot(point) - sign * known.offset) <= distance_)
        return;
    }
    bool flat = false;
    for (int k = 0; k < count(); ++k)
      if (in_plane(k, normal, plane.offset)) {
        plane.wires.push_back(k);
        flat = flat || wire(k).form != WireForm::straight;
      }
    if (plane.wires.size() >= (flat ? 2U : 3U)) structure_.planes.push_back(std::move(plane));
  }

  void find_planes() {
    for (int k = 0; k < count(); ++k)
      if (wire(k).form == WireForm::circular || wire(k).form == WireForm::planar)
        add_plane(wire(k).axis, points(k).rowwise().mean());
    for (const WireJunction& junction : structure_.junctions)
      for (std::size_t i = 0; i < junction.wires.size(); ++i)
        for (std::size_t j = i + 1; j < junction.wires.size(); ++j) {
          const Wire &a = wire(junction.wires[i]), &b = wire(junction.wires[j]);
          if (a.form != WireForm::straight || b.form != WireForm::straight) continue;
          const Eigen::Vector3d normal = a.axis.cross(b.axis);
          if (normal.norm() > std::max(sine_, options_.form_tolerance))
            add_plane(normal.normalized(), shape_.vertices.row(junction.vertex).transpose());
        }
  }

  /// Returns the largest distance of the images of the points of a from the polygon of b.
  double mismatch(const Eigen::Isometry3d& map, int a, int b) const {
    const PointColumns& onto = points(b);
    const Eigen::Index n = onto.cols();
    double largest = 0;
    for (const auto& p : points(a).colwise()) {
      const Eigen::Vector3d q = map * Eigen::Vector3d(p);
      double nearest = (onto.col(0) - q).norm();
      for (Eigen::Index i = 0; i + (wire(b).curve.closed ? 0 : 1) < n; ++i) {
        const Eigen::Vector3d from = onto.col(i), along = onto.col((i + 1) % n) - from;
        const double t = std::clamp((q - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (from + t * along - q).norm());
      }
      largest = std::max(largest, nearest);
      if (largest > distance_) break;
    }
    return largest;
  }

  void find_symmetric() {
    structure_.symmetries = options_.symmetries;
    for (std::size_t s = 0; s < structure_.symmetries.size(); ++s) {
      const Eigen::Isometry3d map = isometry_of(structure_.symmetries[s]);
      for (int a = 0; a < count(); ++a)
        for (int b = 0; b < count(); ++b)
          if (wire(a).form == wire(b).form && wire(a).curve.closed == wire(b).curve.closed &&
              equal(wire(a).length, wire(b).length) &&
              (map * wire(a).centre - wire(b).centre).norm() <= distance_ &&
              mismatch(map, a, b) <= distance_) {
            structure_.symmetric.push_back({static_cast<int>(s), a, b});
            break;
          }
    }
  }

  const Shape& shape_;
  const WireAnalysisOptions& options_;
  WireStructure& structure_;
  double sine_, distance_;
  std::vector<PointColumns> points_;
};

}  // namespace

WireStructure analysed_wires(const Shape& shape, const std::vector<FeatureCurve>& curves,
                             const WireAnalysisOptions& options) {
  check(options);
  WireStructure structure;
  for (const FeatureCurve& curve : curves) structure.wires.push_back(described(shape, curve, options));
  Relations(shape, options, structure).find();
  return structure;
}

}  // namespace stackabilization
