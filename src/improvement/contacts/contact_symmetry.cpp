#include "improvement/contacts/contact_symmetry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "stackabilization/structure/tolerances.h"
#include "structure/model/symmetry_orbit.h"

namespace stackabilization::detail {

namespace {

bool nearly(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a - b).norm() <= tolerance::same_symmetry * b.norm();
}

/// Returns the height of `p` along the axis of a revolution, and its distance from the axis.
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
      for (std::size_t g = 0; g < orbits[k].group.size(); ++g)
        place.onto_itself.push_back(place.from_first * orbits[k].group[g] * place.from_first.inverse());
    }
  for (const Relation& relation : structure.relations) {
    if (relation.type != RelationType::self_symmetry || relation.symmetry.kind != SymmetryKind::revolution)
      continue;
    places_[static_cast<std::size_t>(relation.parts.front())].revolutions.push_back(relation.symmetry);
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

std::optional<Eigen::Vector3d> ContactSymmetry::allowed_move(int part, const Eigen::Vector3d& centre,
                                                             const Eigen::Vector3d& by) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (const Eigen::Isometry3d& map : place(part).onto_itself) {
    if ((map * centre - centre).norm() > near_) continue;
    sum += map.linear() * by;
    ++count;
  }
  Eigen::Vector3d allowed = count > 0 ? Eigen::Vector3d(sum / count) : by;
  for (const Symmetry& one : place(part).revolutions)
    if (around(one, centre).y() <= near_) allowed = allowed.dot(one.axis) * one.axis;
  if (!nearly(allowed, by)) return std::nullopt;
  return allowed;
}

std::optional<Eigen::Vector3d> ContactSymmetry::allowed_axis(int part, const Eigen::Vector3d& axis) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Isometry3d& map : place(part).onto_itself) {
    const Eigen::Vector3d image = map.linear() * axis;
    sum += image.dot(axis) < 0 ? Eigen::Vector3d(-image) : image;
  }
  Eigen::Vector3d allowed = sum.isZero() ? axis : Eigen::Vector3d(sum.normalized());
  for (const Symmetry& one : place(part).revolutions) {
    const double along = allowed.dot(one.axis);
    allowed = along < 0 ? Eigen::Vector3d(-one.axis) : one.axis;
  }
  if (!nearly(allowed, axis)) return std::nullopt;
  return allowed;
}

std::vector<int> different_regions(const std::vector<ContactRegion>& regions, const ContactSymmetry& symmetry,
                                   int most) {
  std::vector<int> chosen;
  for (std::size_t k = 0; k < regions.size() && static_cast<int>(chosen.size()) < most; ++k) {
    const ContactRegion& one = regions[k];
    const bool seen = std::any_of(chosen.begin(), chosen.end(), [&](int row) {
      const ContactRegion& other = regions[static_cast<std::size_t>(row)];
      return one.type == other.type &&
             symmetry.same_place(other.upper_part, other.upper_centre, one.upper_part, one.upper_centre) &&
             symmetry.same_place(other.lower_part, other.lower_centre, one.lower_part, one.lower_centre);
    });
    if (!seen) chosen.push_back(static_cast<int>(k));
  }
  return chosen;
}

}  // namespace stackabilization::detail
