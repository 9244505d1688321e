#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "improvement/contacts/contact_side.h"

// Handles for one side of a contact region: faces, corners, cross-sections and whole parts near the contact.
namespace stackabilization::detail {

/// A handle near a contact, with its geometry and its role.
struct ContactHandle {
  enum class Role {
    nearest,  ///< closest to the contact
    end,      ///< an end of the touched part
    whole,    ///< the touched part as a whole
  };
  Handle handle;
  Role role = Role::nearest;
  Falloff falloff = Falloff::gaussian;
  /// Face of a plate. The touched face moves along r only, an edge face along its normal only. Neither is
  /// scaled: that would slant the edge of the plate.
  bool of_plate = false;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  /// Points that move with the handle, n x 3.
  Points points;
  double radius = 0;                                 ///< radius of a cross-section around `centre`; else 0
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit normal of a cross-section or face; else 0
  /// Unit axis of a part that leans as a whole, to the end near the contact; else 0. The other members then
  /// describe its nearest cross-section.
  Eigen::Vector3d lean_axis = Eigen::Vector3d::Zero();
  double lean_share = 1;  ///< fraction of a leaning by which that cross-section moves

  bool leans() const { return !lean_axis.isZero(0); }

  /// Returns the interval that the handle covers along the unit vector `axis`, model units.
  Range range(const Eigen::Vector3d& axis) const;
};

/// Returns the corners of all triangles of a part, 3 rows per triangle.
Points part_points(const Shape& shape, int part);

/// Returns the handles for one side of a region, ordered by role. Ends and the whole part only in the
/// extended family.
std::vector<ContactHandle> contact_handles(const ContactSituation& situation, const ContactSide& side,
                                           const ContactFrame& frame, const ContactEditOptions& options);

/// Returns the part that is widest across w, if it is round about w: the body of a vessel. -1: it is not.
int round_body(const std::vector<Primitive>& primitives, const ContactFrame& frame);

/// Returns the tapers of the whole shape with a factor: towards either end of the extent along w, along u,
/// along v and along both. Only along both where there is a round body: its circles stay circles, so tapers
/// along u or v do less of the same.
std::vector<Edit> tapers(const ContactFrame& frame, const std::vector<Primitive>& primitives, double factor);

}  // namespace stackabilization::detail
