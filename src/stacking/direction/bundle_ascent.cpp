#include "stackabilization/stacking/bundle_ascent.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization {

namespace {

constexpr int max_rounds = 120;                  ///< trials per climb
constexpr std::int64_t directions_per_step = 3;  ///< a trial, and two for its slopes
constexpr std::size_t max_planes = 12;           ///< of the latest trials
constexpr double widest_chart = 0.1;             ///< tangent coordinates beyond this start a new chart

/// Linear model of one of the smooth functions whose minimum is S, near a point of the chart.
struct Plane {
  Eigen::Vector2d at, slope;
  double value;

  double operator()(const Eigen::Vector2d& p) const { return value + slope.dot(p - at); }
};

/// The minimum of some planes over the square |p - centre| <= radius.
class Model {
 public:
  Model(const std::vector<Plane>& planes, const Eigen::Vector2d& centre, double radius)
      : planes_(planes), centre_(centre), radius_(radius), best_(centre), best_value_(value(centre)) {}

  /// Finds its maximum: at a corner of the square, at the intersection of two planes and a side of the
  /// square, or at the intersection of three planes.
  Eigen::Vector2d maximum() {
    for (const double x : {-radius_, radius_})
      for (const double y : {-radius_, radius_}) consider(centre_ + Eigen::Vector2d(x, y));
    for (std::size_t i = 0; i < planes_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        for (const int side : {0, 1})
          for (const double offset : {-radius_, radius_}) consider_side(planes_[i], planes_[j], side, offset);
        for (std::size_t k = 0; k < j; ++k) consider_corner(planes_[i], planes_[j], planes_[k]);
      }
    return best_;
  }
  double maximum_value() const { return best_value_; }

 private:
  double value(const Eigen::Vector2d& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Plane& plane : planes_) least = std::min(least, plane(p));
    return least;
  }
  void consider(const Eigen::Vector2d& p) {
    if (!((p - centre_).cwiseAbs().maxCoeff() <= radius_ * (1 + tolerance::relative))) return;
    if (value(p) <= best_value_) return;
    best_ = p;
    best_value_ = value(p);
  }
  void consider_side(const Plane& a, const Plane& b, int side, double offset) {
    Eigen::Vector2d p = centre_;
    p[side] += offset;
    const double slope = a.slope[1 - side] - b.slope[1 - side];
    if (slope == 0) return;
    p[1 - side] -= (a(p) - b(p)) / slope;
    consider(p);
  }
  void consider_corner(const Plane& a, const Plane& b, const Plane& c) {
    Eigen::Matrix2d slopes;
    slopes << (a.slope - b.slope).transpose(), (a.slope - c.slope).transpose();
    if (slopes.determinant() == 0) return;
    consider(centre_ - slopes.inverse() * Eigen::Vector2d(a(centre_) - b(centre_), a(centre_) - c(centre_)));
  }

  const std::vector<Plane>& planes_;
  Eigen::Vector2d centre_;
  double radius_;
  Eigen::Vector2d best_;
  double best_value_;
};

class BundleAscent {
 public:
  BundleAscent(const StackabilitySolver& solver, const DirectionRegion& region, const Stackability& start)
      : solver_(solver), region_(region), climb_{start} {}

  LocalOptimum run(const AscentOptions& options) {
    radius_ = options.first_step;
    if (options.max_directions < directions_per_step) return climb_;
    start_chart();
    for (int round = 0; round < max_rounds && radius_ > options.last_step; ++round) {
      if (climb_.evaluated + directions_per_step > options.max_directions) break;
      if (options.cancelled && options.cancelled()) break;
      improve();
    }
    return climb_;
  }

 private:
  Eigen::Vector3d direction_at(const Eigen::Vector2d& p) const {
    return (chart_.w + chart_.u * p.x() + chart_.v * p.y()).normalized();
  }
  Eigen::Vector2d chart_point(const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d local = chart_.to_local(direction);
    return local.head<2>() / local.z();
  }
  Stackability measure(const Eigen::Vector3d& direction) {
    ++climb_.evaluated;
    return solver_.measure(Direction(direction));
  }

  void start_chart() {
    chart_ = frame_of(Direction(climb_.at.direction));
    planes_.clear();
    add_plane(Eigen::Vector2d::Zero(), climb_.at.value);
  }
  void add_plane(const Eigen::Vector2d& p, double value);
  std::vector<Plane> planes_here(const Eigen::Vector2d& centre) const;
  void improve();

  const StackabilitySolver& solver_;
  const DirectionRegion& region_;
  LocalOptimum climb_;
  Frame chart_;
  double radius_ = 0;
  std::vector<Plane> planes_;
};

void BundleAscent::add_plane(const Eigen::Vector2d& p, double value) {
  const double width =
      std::clamp(radius_ / 100, tolerance::direction_step / 10, 100 * tolerance::direction_step);
  Plane plane{p, Eigen::Vector2d::Zero(), value};
  for (int k = 0; k < 2; ++k)
    plane.slope[k] = (measure(direction_at(p + width * Eigen::Vector2d::Unit(k))).value - value) / width;
  if (planes_.size() == max_planes) planes_.erase(planes_.begin());
  planes_.push_back(plane);
}

/// Planes of the trust region. A plane below S at the centre comes from a point where S is not concave; it is
/// raised to S.
std::vector<Plane> BundleAscent::planes_here(const Eigen::Vector2d& centre) const {
  std::vector<Plane> here;
  for (Plane plane : planes_) {
    if ((plane.at - centre).norm() > 4 * radius_) continue;
    plane.value += std::max(0.0, climb_.at.value - plane(centre));
    here.push_back(plane);
  }
  return here;
}

void BundleAscent::improve() {
  const Eigen::Vector2d centre = chart_point(climb_.at.direction);
  const std::vector<Plane> planes = planes_here(centre);
  Model model(planes, centre, radius_);
  const std::optional<Eigen::Vector3d> trial = region_.nearest(direction_at(model.maximum()));
  const double expected = model.maximum_value() - climb_.at.value;
  if (!trial || !(expected > tolerance::stackability)) {
    radius_ /= 4;
    return;
  }
  const Stackability found = measure(*trial);
  const double gain = found.value - climb_.at.value;
  const Eigen::Vector2d p = chart_point(*trial);
  if (gain > tolerance::stackability) climb_.at = found;
  radius_ *= gain > expected / 2 ? 2 : gain > expected / 10 ? 1 : 0.5;
  if (gain > 0 && p.norm() > widest_chart)
    start_chart();
  else
    add_plane(p, found.value);
}

}  // namespace

LocalOptimum bundle_ascent(const StackabilitySolver& solver, const DirectionRegion& region,
                           const Stackability& start, const AscentOptions& options) {
  return BundleAscent(solver, region, start).run(options);
}

}  // namespace stackabilization
