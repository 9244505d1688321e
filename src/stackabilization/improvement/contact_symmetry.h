#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "stackabilization/structure/structure.h"

/// Not installed.
namespace stackabilization::detail {

/// What the symmetry relations of a structure say about places on its parts.
class ContactSymmetry {
 public:
  explicit ContactSymmetry(const Structure& structure);

  /// Do symmetries take `p` on part `a` to `q` on part `b`, within tolerance::same_symmetry?
  bool same_place(int a, const Eigen::Vector3d& p, int b, const Eigen::Vector3d& q) const;
  /// Can a handle with this centre move by `by` without another handle of its part moving too? Not across a
  /// mirror plane or axis that it lies on.
  bool can_move(int part, const Eigen::Vector3d& centre, const Eigen::Vector3d& by) const;
  /// Can the part be scaled along `axis`? Not when it is symmetric to an image of that axis.
  bool can_scale(int part, const Eigen::Vector3d& axis) const;

 private:
  /// Maps of the first part of an orbit.
  struct Place {
    int orbit = -1;  ///< parts with the same number are symmetric to each other; -1: to none
    Eigen::Isometry3d from_first = Eigen::Isometry3d::Identity();
    std::vector<Eigen::Isometry3d> onto_itself;  ///< of the part, without the identity
    std::vector<Symmetry> revolutions;           ///< of the part
  };
  const Place& place(int part) const { return places_[static_cast<std::size_t>(part)]; }

  std::vector<Place> places_;
  double near_ = 0;  ///< model units
};

}  // namespace stackabilization::detail
