#include "deformation/controllers/propagation.h"

#include <Eigen/LU>

#include "core/index.h"
#include "numerics/polar_decomposition.h"
#include "stackabilization/deformation/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Weight that pulls the part of a rotation that the joints leave undetermined towards the identity, relative
/// to the spread of the joints.
constexpr double rotation_pull = 0.000001;
/// The same weight for the strain.
constexpr double strain_pull = 0.001;

/// p -> linear (p - from) + to; `rotation` is the rotation in `linear`.
struct AffineMotion {
  Eigen::Matrix3d linear, rotation;
  Eigen::Vector3d from, to;
};

/// Fits the rotation that best maps the rows of `p` to those of `q` (Kabsch), then the least strain for the
/// residual.
AffineMotion fitted(const Points& p, const Points& q) {
  AffineMotion motion{Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity(),
                      p.colwise().mean().transpose(), q.colwise().mean().transpose()};
  const Points from = p.rowwise() - motion.from.transpose(), to = q.rowwise() - motion.to.transpose();
  const double spread = from.squaredNorm();
  if (!(spread > 0)) return motion;
  const Eigen::Matrix3d covariance =
      to.transpose() * from + rotation_pull * spread * Eigen::Matrix3d::Identity();
  motion.rotation = polar_decomposition(covariance).rotation;
  const Points turned = from * motion.rotation.transpose();
  const Eigen::Matrix3d moments =
      turned.transpose() * turned + strain_pull * spread * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d strain = ((to - turned).transpose() * turned) * moments.inverse();
  motion.linear = motion.rotation + strain * motion.rotation;
  return motion;
}

Primitive moved(Primitive primitive, const AffineMotion& motion) {
  const auto move = [&](auto& points) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      points.row(i) = (motion.linear * (points.row(i).transpose() - motion.from) + motion.to).transpose();
  };
  if (auto* cuboid = std::get_if<Cuboid>(&primitive)) {
    move(cuboid->corners);
  } else {
    auto& cylinder = std::get<GeneralizedCylinder>(primitive);
    move(cylinder.centres);
    cylinder.rotation = Eigen::Quaterniond(motion.rotation) * cylinder.rotation;
  }
  return primitive;
}

class Propagation {
 public:
  Propagation(const Rig& rig, std::vector<ControlState> states, std::vector<Progress> progress)
      : rig_(rig),
        states_(std::move(states)),
        progress_(std::move(progress)),
        now_(rig.space.primitives(states_)) {}

  std::vector<ControlState> run() {
    for (int part = next(); part >= 0; part = next()) follow(part);
    return std::move(states_);
  }

 private:
  Progress& progress(int part) { return progress_[at(rig_.space.class_of(part))]; }

  /// Returns the open part with most modified neighbours, or -1.
  int next() {
    std::vector<std::vector<int>> neighbours(now_.size());
    const auto meet = [&](int part, int other) {
      if (progress(part) != Progress::open || progress(other) != Progress::modified) return;
      std::vector<int>& known = neighbours[at(part)];
      if (std::find(known.begin(), known.end(), other) == known.end()) known.push_back(other);
    };
    for (const JointPoint& joint : rig_.joints) {
      meet(joint.parts[0], joint.parts[1]);
      meet(joint.parts[1], joint.parts[0]);
    }
    int best = -1;
    std::size_t most = 0;
    for (int part = 0; part < static_cast<int>(neighbours.size()); ++part)
      if (neighbours[at(part)].size() > most) most = neighbours[at(part)].size(), best = part;
    return best;
  }

  /// Moves the part and its class to the current positions of its joints with parts that are not open.
  void follow(int part) {
    std::vector<Eigen::Vector3d> from, to;
    double farthest = 0;
    for (const JointPoint& joint : rig_.joints)
      for (const std::size_t side : {0u, 1u}) {
        const int other = joint.parts[1 - side];
        if (joint.parts[side] != part || progress(other) == Progress::open) continue;
        from.push_back(rig_.primitive_bindings[at(part)].position_of(joint.bindings[side], now_[at(part)]));
        to.push_back(
            rig_.primitive_bindings[at(other)].position_of(joint.bindings[1 - side], now_[at(other)]));
        farthest = std::max(farthest, (to.back() - from.back()).norm());
      }
    if (farthest <= tolerance::solve * rig_.rest.diagonal) {
      progress(part) = Progress::settled;
      return;
    }
    Points p(static_cast<Eigen::Index>(from.size()), 3), q(p.rows(), 3);
    for (std::size_t i = 0; i < from.size(); ++i) {
      p.row(static_cast<Eigen::Index>(i)) = from[i];
      q.row(static_cast<Eigen::Index>(i)) = to[i];
    }
    const int of_class = rig_.space.class_of(part);
    states_[at(of_class)] =
        rig_.space.invariant(of_class, rig_.space.state_of(part, moved(now_[at(part)], fitted(p, q))));
    for (const int member : rig_.space.members(of_class))
      now_[at(member)] = rig_.space.primitive(member, states_[at(of_class)]);
    progress(part) = Progress::modified;
  }

  const Rig& rig_;
  std::vector<ControlState> states_;
  std::vector<Progress> progress_;  ///< per class
  std::vector<Primitive> now_;
};

}  // namespace

std::vector<ControlState> propagate(const Rig& rig, std::vector<ControlState> states,
                                    std::vector<Progress> progress) {
  return Propagation(rig, std::move(states), std::move(progress)).run();
}

}  // namespace stackabilization::detail
