#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "stackabilization/envelope/contacts.h"
#include "stackabilization/structure/structure.h"

// Symmetries as seen by contacts: equivalent places, and the moves and scalings that symmetries allow.
namespace stackabilization::detail {

/// Action of the symmetry relations of a structure on places of its parts.
class ContactSymmetry {
 public:
  explicit ContactSymmetry(const Structure& structure);

  /// Returns whether a symmetry maps `p` on part `a` to `q` on part `b`, within tolerance::same_symmetry.
  bool same_place(int a, const Eigen::Vector3d& p, int b, const Eigen::Vector3d& q) const;
  /// Returns the component of `by` that symmetries allow for a handle with this centre while the other
  /// handles of its part stay: no move across a mirror plane through the centre, or off an axis through it.
  /// Nothing when this component differs from `by` by more than tolerance::same_symmetry (relative). The
  /// component itself satisfies the symmetries exactly.
  std::optional<Eigen::Vector3d> allowed_move(int part, const Eigen::Vector3d& centre,
                                              const Eigen::Vector3d& by) const;
  /// Returns the unit vector near `axis` along which symmetries allow the part to be scaled. Nothing where
  /// symmetries map the axis to other axes.
  std::optional<Eigen::Vector3d> allowed_axis(int part, const Eigen::Vector3d& axis) const;

 private:
  struct Place {
    /// Orbit: parts with the same number are symmetric to each other. -1: symmetric to no part.
    int orbit = -1;
    Eigen::Isometry3d from_first = Eigen::Isometry3d::Identity();
    /// Isometries that map the part onto itself: a group, the identity first.
    std::vector<Eigen::Isometry3d> onto_itself;
    std::vector<Symmetry> revolutions;  ///< revolutions of the part
  };
  const Place& place(int part) const { return places_[static_cast<std::size_t>(part)]; }

  std::vector<Place> places_;
  double near_ = 0;  ///< distance within which places are the same, model units
};

/// Returns the rows of regions that no symmetry maps onto an earlier one of the same type; at most `most`.
std::vector<int> different_regions(const std::vector<ContactRegion>& regions, const ContactSymmetry& symmetry,
                                   int most);

}  // namespace stackabilization::detail
