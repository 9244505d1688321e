#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "improvement/contacts/contact_side.h"

/// Not installed.
namespace stackabilization::detail {

/// Something to take hold of, and what goes with it.
struct ContactHandle {
  enum class Role {
    nearest,  ///< lies at the contact
    end,      ///< the end of a part that the contact is on
    whole,    ///< the part
  };
  Handle handle;
  Role role = Role::nearest;
  Falloff falloff = Falloff::gaussian;
  /// A face of a plate: only moved along its normal, never scaled, for the edge of the plate would slant.
  bool of_plate = false;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Points points;                                     ///< that move with it
  double radius = 0;                                 ///< of a cross-section around `centre`
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit: of a cross-section or face; else zero

  /// What it takes along `axis` (unit).
  Range range(const Eigen::Vector3d& axis) const;
};

/// Coordinates of the corners of all triangles of a part of the design.
Points part_points(const Shape& shape, int part);

/// Handles for a side, nearest first; ends and the whole only in the extended family.
std::vector<ContactHandle> contact_handles(const ContactSituation& situation, const ContactSide& side,
                                           const ContactFrame& frame, const ContactEditOptions& options);

}  // namespace stackabilization::detail
