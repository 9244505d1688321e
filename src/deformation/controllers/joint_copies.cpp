#include "deformation/controllers/joint_copies.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/index.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Largest change of a control value in the generic trial state, fraction of the diagonal.
constexpr double trial = 0.02;

/// A symmetry that maps one part onto another, or onto itself.
struct Way {
  int to;
  Eigen::Isometry3d map;
};

class JointCopies {
 public:
  explicit JointCopies(const Rig& rig) : rig_(rig), ways_(rig.rest.parts.size()) {
    for (const Relation& relation : rig.rest.relations) {
      if (relation.type != RelationType::symmetry && relation.type != RelationType::self_symmetry) continue;
      const int from = relation.parts.front(), to = relation.parts.back();
      const Eigen::Isometry3d map = isometry_of(relation.symmetry);
      ways_[at(from)].push_back({to, map});
      ways_[at(to)].push_back({from, map.inverse()});
    }
    for (std::size_t k = 0; k < rig.joints.size(); ++k)
      by_parts_[std::minmax(rig.joints[k].parts[0], rig.joints[k].parts[1])].push_back(static_cast<int>(k));
    try_out();
  }

  std::vector<int> distinct() const {
    DisjointSets sets(rig_.joints.size());
    for (int k = 0; k < static_cast<int>(rig_.joints.size()); ++k)
      for (const Way& first : ways_[at(rig_.joints[at(k)].parts[0])])
        for (const Way& second : ways_[at(rig_.joints[at(k)].parts[1])])
          if (first.map.isApprox(second.map, tolerance::relative))
            for (const int copy : copies(k, first, second.to)) sets.join(at(k), at(copy));
    std::vector<int> first;
    for (std::size_t k = 0; k < rig_.joints.size(); ++k)
      if (sets.root(k) == k) first.push_back(static_cast<int>(k));
    return first;
  }

 private:
  /// Computes the positions and gaps of the joints in a generic state within the subspaces of the classes.
  void try_out() {
    std::vector<ControlState> states(at(rig_.space.class_count()));
    double phase = 0;
    for (std::size_t c = 0; c < states.size(); ++c) {
      Eigen::VectorXd amounts(rig_.bases[c].cols());
      for (double& amount : amounts) {
        phase += 1;
        amount = std::sin(phase * phase);
      }
      states[c].values = rig_.bases[c] * amounts;
      const double largest = states[c].values.size() > 0 ? states[c].values.cwiseAbs().maxCoeff() : 0;
      if (largest > 0) states[c].values *= trial * rig_.rest.diagonal / largest;
    }
    const std::vector<Primitive> now = rig_.space.primitives(states);
    for (const JointPoint& joint : rig_.joints) {
      const auto place = [&](std::size_t side) {
        const std::size_t part = at(joint.parts[side]);
        return rig_.primitive_bindings[part].position_of(joint.bindings[side], now[part]);
      };
      places_.push_back(place(0));
      gaps_.push_back(place(0) - place(1));
    }
  }

  /// Returns the joints at the image of joint `k`, between the images of its parts. `first`: the map and the
  /// image of its first part. `second`: the image of its second part.
  std::vector<int> copies(int k, const Way& first, int second) const {
    std::vector<int> found;
    const auto list = by_parts_.find(std::minmax(first.to, second));
    if (list == by_parts_.end()) return found;
    const double slack = tolerance::relative * rig_.rest.diagonal;
    for (const int other : list->second) {
      // The gap of the copy has the opposite sign when its parts are in the opposite order.
      const bool same = rig_.joints[at(other)].parts[0] == first.to;
      const Eigen::Vector3d gap = same ? gaps_[at(other)] : Eigen::Vector3d(-gaps_[at(other)]);
      const Eigen::Vector3d place = same ? places_[at(other)] : Eigen::Vector3d(places_[at(other)] + gap);
      if ((first.map.linear() * gaps_[at(k)] - gap).norm() <= slack &&
          (first.map * places_[at(k)] - place).norm() <= slack)
        found.push_back(other);
    }
    return found;
  }

  const Rig& rig_;
  std::vector<std::vector<Way>> ways_;                        ///< per part
  std::map<std::pair<int, int>, std::vector<int>> by_parts_;  ///< lower part first
  /// Positions and gaps of the joints in the trial state.
  std::vector<Eigen::Vector3d> places_, gaps_;
};

}  // namespace

std::vector<int> distinct_joints(const Rig& rig) {
  return JointCopies(rig).distinct();
}

}  // namespace stackabilization::detail
