#include "structure/analysis/joint_symmetry.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "core/transformed_points.h"
#include "structure/analysis/symmetrize.h"
#include "structure/model/symmetry_orbit.h"

namespace stackabilization::detail {

namespace {

/// A joint and the image of another nearer than this, fraction of the diagonal, are meant to be the same.
constexpr double same_joint = 0.05;

/// Orders symmetries by all their members.
struct ByValue {
  static auto values(const Symmetry& s) {
    return std::tuple(s.kind, s.order, s.point.x(), s.point.y(), s.point.z(), s.axis.x(), s.axis.y(),
                      s.axis.z());
  }

  bool operator()(const Symmetry& a, const Symmetry& b) const { return values(a) < values(b); }
};

/// A symmetry and its known images of parts.
struct Action {
  Symmetry symmetry;
  std::map<int, int> parts;
};

std::vector<Action> actions_of(const Structure& structure) {
  std::vector<Action> actions;
  std::map<Symmetry, std::size_t, ByValue> rows;
  for (const Relation& relation : structure.relations) {
    const auto [row, is_new] = rows.try_emplace(relation.symmetry, actions.size());
    if (is_new) actions.push_back({relation.symmetry, {}});
    std::map<int, int>& parts = actions[row->second].parts;
    parts[relation.parts.front()] = relation.parts.back();
    if (relation.symmetry.kind == SymmetryKind::reflection)
      parts[relation.parts.back()] = relation.parts.front();
  }
  return actions;
}

/// Returns the largest distance between corresponding points of two joints; the ends of lines may be
/// exchanged. For a point and a line it is the distance between their midpoints.
double distance(const Points& a, const Points& b) {
  if (a.rows() != b.rows()) return (a.colwise().mean() - b.colwise().mean()).norm();
  const Points reversed = b.colwise().reverse();
  return std::min((a - b).rowwise().norm().maxCoeff(), (a - reversed).rowwise().norm().maxCoeff());
}

class JointSymmetry {
 public:
  JointSymmetry(const std::vector<Relation>& joints, const Structure& structure)
      : structure_(structure),
        joints_(joints),
        actions_(actions_of(structure)),
        actions_on_(structure.parts.size()) {
    for (std::size_t a = 0; a < actions_.size(); ++a)
      for (const auto& [part, image] : actions_[a].parts)
        actions_on_[static_cast<std::size_t>(part)].push_back(a);
    for (std::size_t k = 0; k < joints_.size(); ++k) rows_[joints_[k].parts].push_back(k);
  }

  std::vector<Relation> run() {
    // The list grows by images of images. The group is finite, so it stays short.
    const std::size_t most = joints_.size() * max_growth;
    for (std::size_t k = 0; k < joints_.size() && joints_.size() <= most; ++k)
      for (const std::size_t a : actions_on_[static_cast<std::size_t>(joints_[k].parts[0])])
        follow(k, actions_[a]);
    average();
    return joints_;
  }

 private:
  static constexpr std::size_t max_growth = 16;

  void follow(std::size_t row, const Action& action) {
    const Relation joint = joints_[row];
    const auto a = action.parts.find(joint.parts[0]), b = action.parts.find(joint.parts[1]);
    if (a == action.parts.end() || b == action.parts.end() || a->second == b->second) return;
    Relation image = joint;
    image.parts = {std::min(a->second, b->second), std::max(a->second, b->second)};
    image.points = transformed(joint.points, isometry_of(action.symmetry));
    const std::optional<std::size_t> found = nearest(image);
    const std::size_t target = found.value_or(joints_.size());
    if (!found) {
      joints_.push_back(image);
      rows_[image.parts].push_back(target);
    }
    if (joints_[target].type != image.type) {
      if (linked_.count(target) > 0) return;  // what its image is, is settled
      joints_[target].type = image.type;
      joints_[target].points = image.points;
    }
    Relation link{.type = target == row ? RelationType::self_symmetry : RelationType::symmetry,
                  .parts = {static_cast<int>(row)},
                  .symmetry = action.symmetry,
                  .points = {}};
    if (target != row) link.parts.push_back(static_cast<int>(target));
    links_.push_back(link);
    linked_.insert({row, target});
  }

  /// Returns the nearest joint that is meant to be `image`: one of its type, where there is one.
  std::optional<std::size_t> nearest(const Relation& image) const {
    std::optional<std::size_t> best;
    std::pair least{true, same_joint * structure_.diagonal};
    const auto rows = rows_.find(image.parts);
    if (rows == rows_.end()) return best;
    for (const std::size_t k : rows->second) {
      const double apart = distance(joints_[k].points, image.points);
      const std::pair miss{joints_[k].type != image.type, apart};
      if (apart >= same_joint * structure_.diagonal || miss >= least) continue;
      least = miss;
      best = k;
    }
    return best;
  }

  /// Joints behave as curves of one or two sections.
  void average() {
    Structure curves;
    curves.diagonal = structure_.diagonal;
    curves.relations = links_;
    for (const Relation& joint : joints_) {
      GeneralizedCylinder curve;
      curve.centres = joint.points;
      curve.radii = Eigen::VectorXd::Ones(joint.points.rows());
      curves.parts.push_back({"", curve, {}});
    }
    const OrbitsOrContradiction found = find_orbits(curves);
    if (found.contradiction) return;
    for (const Orbit& orbit : found.orbits) make_symmetric(curves, orbit);
    for (std::size_t k = 0; k < joints_.size(); ++k)
      joints_[k].points = control_points(curves.parts[k].primitive);
  }

  const Structure& structure_;
  std::vector<Relation> joints_;
  std::vector<Action> actions_;
  std::vector<std::vector<std::size_t>> actions_on_;           ///< rows of the actions per part, ascending
  std::map<std::vector<int>, std::vector<std::size_t>> rows_;  ///< of the joints, per parts, ascending
  std::vector<Relation> links_;                                ///< symmetries between rows of `joints_`
  std::set<std::size_t> linked_;                               ///< rows of `joints_` that they relate
};

}  // namespace

std::vector<Relation> symmetric_joints(const std::vector<Relation>& joints, const Structure& structure) {
  return JointSymmetry(joints, structure).run();
}

}  // namespace stackabilization::detail
