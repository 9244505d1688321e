#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "stackabilization/improvement/contact_edits.h"

/// Not installed.
namespace stackabilization::detail {

/// The axes along which contacts are pulled apart: r, and the sides of the box around the shape across it.
struct ContactFrame {
  Eigen::Vector3d u, v, w;  ///< unit, orthogonal; w = r / |r|
  Eigen::Vector3d centre;   ///< of the box
  Range height;             ///< of the design along w
};

/// The first mirror plane of the structure that contains r gives u; without one the least rectangle around
/// the projection does.
ContactFrame contact_frame(const ContactSituation& situation);

/// One of the two surfaces that touch.
struct ContactSide {
  const ContactRegion& region;
  int row = 0;                ///< of the region
  bool of_lower_copy = true;  ///< this surface belongs to the copy below
  int part = 0, other = 0;    ///< of this surface, and of the one that it touches
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  bool on_end = false;  ///< on the top or bottom of the extent along r
};

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
                                           const ContactFrame& frame, EditFamily family);

}  // namespace stackabilization::detail
