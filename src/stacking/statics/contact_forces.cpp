#include "stacking/statics/contact_forces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "numerics/linear_programme.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/tolerances.h"
#include "stacking/statics/border_margin.h"

namespace stackabilization::detail {

namespace {

constexpr int friction_sides = 32;
/// What a force that is lacking costs, for programmes to have solutions: more than it can bring.
constexpr double price_of_lack = 1e6;
/// Tangents of tilts that differ by less are the same.
constexpr double same_tilt = 10 * tolerance::relative;
/// Supporting lines after which the border counts as found.
constexpr int max_lines = 200;

/// A linear programme of forces in balance, in which forces may be lacking at a price.
class BalanceProgramme {
 public:
  /// `columns`: per non-negative unknown what it adds to each row. `sums`: what they have to add up to. The
  /// first `balanced` rows may be lacking.
  BalanceProgramme(const Eigen::MatrixXd& columns, Eigen::VectorXd sums, const Eigen::VectorXd& gains,
                   Eigen::Index balanced)
      : unknowns_(columns.cols()) {
    // Both signs of what is lacking. Sums in general position keep the simplex method out of circles.
    for (Eigen::Index row = 0; row < balanced; ++row)
      sums(row) += tolerance::force * std::sqrt(static_cast<double>(row) + 2) / 100;
    const Eigen::Index all = unknowns_ + 2 * balanced;
    programme_.a = Eigen::MatrixXd::Zero(columns.rows(), all);
    programme_.a.leftCols(unknowns_) = columns;
    programme_.a.block(0, unknowns_, balanced, balanced).setIdentity();
    programme_.a.topRightCorner(balanced, balanced) = -Eigen::MatrixXd::Identity(balanced, balanced);
    programme_.b = std::move(sums);
    programme_.c = Eigen::VectorXd::Constant(all, -price_of_lack);
    programme_.c.head(unknowns_) = gains;
  }

  /// Returns the unknowns with the largest gain; nothing where there is no balance.
  std::optional<Eigen::VectorXd> solve() const {
    const LinearMaximum found = maximize(programme_);
    if (found.outcome != LinearOutcome::optimum ||
        found.x.tail(found.x.size() - unknowns_).sum() > tolerance::force)
      return std::nullopt;
    return Eigen::VectorXd(found.x.head(unknowns_));
  }

 private:
  Eigen::Index unknowns_;
  LinearProgramme programme_;
};

/// Returns the unit vector straight up a surface, any one along a level surface.
Eigen::Vector3d up_the_surface(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ() - normal.z() * normal;
  return up.norm() > same_tilt ? up.normalized() : normal.unitOrthogonal();
}

}  // namespace

ContactForces::ContactForces(const std::vector<Hold>& holds, double friction, const Eigen::Vector3d& mass)
    : holds_(holds), friction_(friction) {
  double radius = 0;
  for (const Hold& hold : holds) radius = std::max(radius, (hold.point - mass).norm());
  if (!(radius > 0)) radius = 1;
  const int sides = friction > 0 ? friction_sides : 1;
  const auto columns = static_cast<Eigen::Index>(holds.size()) * sides;
  wrenches_.resize(6, columns);
  Eigen::Index column = 0;
  for (std::size_t k = 0; k < holds.size(); ++k) {
    const Eigen::Vector3d &normal = holds[k].normal, along = up_the_surface(normal),
                          across = normal.cross(along);
    for (int side = 0; side < sides; ++side, ++column) {
      const double angle = 2 * std::numbers::pi * side / sides;
      const Eigen::Vector3d force = normal + friction * (std::cos(angle) * along + std::sin(angle) * across);
      wrenches_.col(column) << force, ((holds[k].point - mass) / radius).cross(force);
      hold_of_.push_back(k);
    }
  }
}

bool ContactForces::balance() const {
  return BalanceProgramme(wrenches_, Eigen::VectorXd::Unit(6, 2), Eigen::VectorXd::Zero(wrenches_.cols()), 6)
      .solve()
      .has_value();
}

/// Returns the tangents of the tilt that forces hold and that is farthest towards a side; nothing if none.
std::optional<Eigen::Vector2d> ContactForces::farthest_tilt(const Eigen::Vector2d& towards) const {
  // Behind the forces: the tangents plus max_tilt, and 2 max_tilt minus those.
  const Eigen::Index forces = wrenches_.cols();
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(8, forces + 4);
  columns.topLeftCorner(6, forces) = wrenches_;
  columns.block<2, 2>(0, forces).setIdentity();
  columns.block<2, 2>(6, forces).setIdentity();
  columns.bottomRightCorner<2, 2>().setIdentity();
  Eigen::VectorXd sums = Eigen::VectorXd::Unit(8, 2);
  sums.head<2>().setConstant(max_tilt);
  sums.tail<2>().setConstant(2 * max_tilt);
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(forces + 4);
  gains.segment<2>(forces) = towards;
  const auto found = BalanceProgramme(columns, sums, gains, 6).solve();
  if (!found) return std::nullopt;
  return Eigen::Vector2d(found->segment<2>(forces).array() - max_tilt);
}

double ContactForces::tilt_margin() const {
  std::vector<Eigen::Vector2d> held;
  // Adds the farthest tilt towards a side; returns whether it is beyond `reached`.
  const auto extend = [&](const Eigen::Vector2d& towards, double reached) {
    const auto tilt = farthest_tilt(towards);
    if (!tilt || !(towards.dot(*tilt) > reached + std::max(same_tilt, tolerance::tilt * std::abs(reached))))
      return false;
    held.push_back(*tilt);
    return true;
  };
  for (int quarter = 0; quarter < 4; ++quarter)
    extend(Eigen::Rotation2Dd(quarter * std::numbers::pi / 2) * Eigen::Vector2d::UnitX(), -2 * max_tilt);
  if (held.empty()) return -std::numeric_limits<double>::infinity();
  BorderMargin margin;
  for (int line = 0; line < max_lines; ++line) {
    margin = border_margin(held, same_tilt);
    const bool wider = extend(margin.outwards, margin.distance);
    // A segment through the origin has two sides.
    if (!(margin.flat && margin.distance == 0 && extend(-margin.outwards, 0)) && !wider) break;
  }
  return std::abs(margin.distance) <= same_tilt ? 0 : std::min(margin.distance, max_tilt);
}

std::optional<Grip> ContactForces::grip(const Eigen::Vector3d& axis) const {
  const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  const auto forces = wrenches_.topRows<3>();
  Eigen::MatrixXd rows(6, wrenches_.cols());
  rows << u.transpose() * forces, v.transpose() * forces, wrenches_.bottomRows<3>(),
      Eigen::RowVectorXd::Ones(wrenches_.cols());
  const Eigen::VectorXd gains = -forces.transpose() * axis;
  const auto found = BalanceProgramme(rows, Eigen::VectorXd::Unit(6, 5), gains, 5).solve();
  if (!found) return std::nullopt;
  Grip grip{gains.dot(*found), 0, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(holds_.size()))};
  for (Eigen::Index column = 0; column < wrenches_.cols(); ++column)
    grip.normal_forces(static_cast<Eigen::Index>(hold_of_[static_cast<std::size_t>(column)])) +=
        (*found)(column);
  for (std::size_t k = 0; k < holds_.size(); ++k) {
    const double slope = holds_[k].normal.dot(axis);
    grip.press += grip.normal_forces(static_cast<Eigen::Index>(k)) *
                  (slope + friction_ * std::sqrt(std::max(0.0, 1 - slope * slope)));
  }
  return grip;
}

}  // namespace stackabilization::detail
