#include "deformation/iwires/wire_modes.h"

#include <Eigen/Geometry>

#include "core/disjoint_sets.h"

namespace stackabilization::detail {

namespace {

/// Returns the groups of wires that change their size by the same factor.
DisjointSets size_groups(const WireStructure& structure, const WireEdit& edit) {
  DisjointSets groups(structure.wires.size());
  for (const WireSymmetry& pair : structure.symmetric)
    groups.join(static_cast<std::size_t>(pair.wire), static_cast<std::size_t>(pair.image));
  // A turn may change a rectangle into a trapezoid.
  if (edit.motion == WireMotion::turn) return groups;
  const std::size_t edited = groups.root(static_cast<std::size_t>(edit.wire));
  const bool released = edit.motion == WireMotion::scale &&
                        structure.wires[static_cast<std::size_t>(edit.wire)].form == WireForm::circular;
  for (const auto& group : structure.congruent) {
    std::vector<std::size_t> members;
    for (const int k : group)
      if (!released || groups.root(static_cast<std::size_t>(k)) != edited)
        members.push_back(static_cast<std::size_t>(k));
    for (const std::size_t member : members) groups.join(members.front(), member);
  }
  return groups;
}

/// Returns the elementary linear maps that a form allows; one for segments and circles.
std::vector<Eigen::Matrix3d> open_maps(WireForm form, const Eigen::Vector3d& axis) {
  const Eigen::Matrix3d along = axis * axis.transpose();
  if (form == WireForm::straight) return {along};
  if (form == WireForm::circular) return {Eigen::Matrix3d::Identity() - along};
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  if (form == WireForm::planar) {
    frame.col(0) = axis.unitOrthogonal();
    frame.col(1) = axis.cross(frame.col(0));
  }
  const int dimensions = form == WireForm::planar ? 2 : 3;
  std::vector<Eigen::Matrix3d> maps;
  for (int i = 0; i < dimensions; ++i)
    for (int j = 0; j < dimensions; ++j) maps.push_back(frame.col(i) * frame.col(j).transpose());
  return maps;
}

}  // namespace

WireModes wire_modes(const WireStructure& structure, const std::vector<Eigen::Vector3d>& axes,
                     const WireEdit& edit) {
  DisjointSets groups = size_groups(structure, edit);
  WireModes modes;
  modes.variables = 3 * static_cast<int>(structure.wires.size());
  std::vector<int> shared(structure.wires.size(), -1);
  for (std::size_t k = 0; k < structure.wires.size(); ++k) {
    const std::size_t root = groups.root(k);
    const std::vector<Eigen::Matrix3d> maps = open_maps(structure.wires[k].form, axes[k]);
    const bool alone = maps.size() > 1;
    if (!alone && shared[root] < 0) shared[root] = modes.variables++;
    auto& own = modes.of_wire.emplace_back();
    for (const Eigen::Matrix3d& map : maps)
      own.push_back({alone ? modes.variables++ : shared[root], 2 / structure.wires[root].length * map});
  }
  return modes;
}

}  // namespace stackabilization::detail
