#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "stackabilization/envelope/contacts.h"
#include "stackabilization/structure/structure.h"

/// Not installed.
namespace stackabilization::detail {

/// What the symmetry relations of a structure say about places on its parts.
class ContactSymmetry {
 public:
  explicit ContactSymmetry(const Structure& structure);

  /// Do symmetries take `p` on part `a` to `q` on part `b`, within tolerance::same_symmetry?
  bool same_place(int a, const Eigen::Vector3d& p, int b, const Eigen::Vector3d& q) const;
  /// The part of `by` that a handle with this centre can move by while the others of its part stay: not
  /// across a mirror plane, or off an axis, that it lies on. Nothing when that differs from `by` by more than
  /// tolerance::same_symmetry: what symmetries allow, they allow exactly.
  std::optional<Eigen::Vector3d> allowed_move(int part, const Eigen::Vector3d& centre,
                                              const Eigen::Vector3d& by) const;
  /// The unit vector near `axis` along which the part can be scaled; nothing where symmetries take that axis
  /// to others.
  std::optional<Eigen::Vector3d> allowed_axis(int part, const Eigen::Vector3d& axis) const;

 private:
  struct Place {
    int orbit = -1;  ///< parts with the same number are symmetric to each other; -1: to none
    Eigen::Isometry3d from_first = Eigen::Isometry3d::Identity();
    std::vector<Eigen::Isometry3d> onto_itself;  ///< a group, the identity first
    std::vector<Symmetry> revolutions;           ///< of the part
  };
  const Place& place(int part) const { return places_[static_cast<std::size_t>(part)]; }

  std::vector<Place> places_;
  double near_ = 0;  ///< model units
};

/// Rows of the first region of each class that symmetries take onto each other, `most` at most.
std::vector<int> different_regions(const std::vector<ContactRegion>& regions, const ContactSymmetry& symmetry,
                                   int most);

}  // namespace stackabilization::detail
