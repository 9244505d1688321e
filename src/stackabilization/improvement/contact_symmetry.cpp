#include "stackabilization/improvement/contact_symmetry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stackabilization/shape/tolerances.h"
#include "stackabilization/structure/symmetry_orbit.h"

namespace stackabilization::detail {

namespace {

/// Is the direction its own image, or for an axis its own line, to tolerance::same_symmetry?
bool keeps(const Eigen::Matrix3d& linear, const Eigen::Vector3d& direction) {
  return (linear * direction - direction).norm() <= tolerance::same_symmetry * direction.norm();
}

/// Height along the axis of a revolution and distance from it.
Eigen::Vector2d around(const Symmetry& revolution, const Eigen::Vector3d& p) {
  const Eigen::Vector3d offset = p - revolution.point;
  const double height = offset.dot(revolution.axis);
  return {height, (offset - height * revolution.axis).norm()};
}

}  // namespace

ContactSymmetry::ContactSymmetry(const Structure& structure)
    : places_(structure.parts.size()), near_(tolerance::same_symmetry * structure.diagonal) {
  const std::vector<Orbit> orbits = find_orbits(structure).orbits;
  for (std::size_t k = 0; k < orbits.size(); ++k)
    for (std::size_t m = 0; m < orbits[k].parts.size(); ++m) {
      Place& place = places_[static_cast<std::size_t>(orbits[k].parts[m])];
      place.orbit = static_cast<int>(k);
      place.from_first = orbits[k].from_first[m];
      for (std::size_t g = 1; g < orbits[k].group.size(); ++g)
        place.onto_itself.push_back(place.from_first * orbits[k].group[g] * place.from_first.inverse());
    }
  for (const Relation& relation : structure.relations) {
    if (relation.type != RelationType::self_symmetry || relation.symmetry.kind != SymmetryKind::revolution)
      continue;
    Place& place = places_[static_cast<std::size_t>(relation.parts.front())];
    place.revolutions.push_back(relation.symmetry);
    const Eigen::Vector3d& pivot = relation.symmetry.point;
    Eigen::Isometry3d quarter = Eigen::Isometry3d::Identity();
    quarter.translate(pivot);
    quarter.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, relation.symmetry.axis));
    quarter.translate(-pivot);
    place.onto_itself.push_back(quarter);
  }
}

bool ContactSymmetry::same_place(int a, const Eigen::Vector3d& p, int b, const Eigen::Vector3d& q) const {
  if (a == b && (p - q).norm() <= near_) return true;
  const Place &from = place(a), &to = place(b);
  if (from.orbit < 0 || from.orbit != to.orbit) return false;
  const Eigen::Vector3d image = to.from_first * (from.from_first.inverse() * p);
  if ((image - q).norm() <= near_) return true;
  const auto lands = [&](const Eigen::Isometry3d& map) { return (map * image - q).norm() <= near_; };
  const auto turns = [&](const Symmetry& one) {
    return (around(one, image) - around(one, q)).norm() <= near_;
  };
  return std::any_of(to.onto_itself.begin(), to.onto_itself.end(), lands) ||
         std::any_of(to.revolutions.begin(), to.revolutions.end(), turns);
}

bool ContactSymmetry::can_move(int part, const Eigen::Vector3d& centre, const Eigen::Vector3d& by) const {
  const auto& maps = place(part).onto_itself;
  return std::none_of(maps.begin(), maps.end(), [&](const Eigen::Isometry3d& map) {
    return (map * centre - centre).norm() <= near_ && !keeps(map.linear(), by);
  });
}

bool ContactSymmetry::can_scale(int part, const Eigen::Vector3d& axis) const {
  const auto& maps = place(part).onto_itself;
  return std::all_of(maps.begin(), maps.end(), [&](const Eigen::Isometry3d& map) {
    return keeps(map.linear(), axis) || keeps(-map.linear(), axis);
  });
}

}  // namespace stackabilization::detail
