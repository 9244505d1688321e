#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/improvement/contact_edits.h"

// The two sides of a contact region, and the frame in which edits separate them.
namespace stackabilization::detail {

/// Frame for separating contacts: w along r, u and v along the sides of the box around the shape across r.
struct ContactFrame {
  Eigen::Vector3d u, v, w;  ///< orthonormal; w = r / |r|
  Eigen::Vector3d centre;   ///< centre of the box, model units
  Range height;             ///< interval of the design along w
  double band = 0;          ///< distance from an end of `height` that counts as on the end, model units

  bool on_end(const Range& along_w) const {
    return along_w.low <= height.low + band || along_w.high >= height.high - band;
  }
};

/// Returns the frame of a situation. u is the normal of the first mirror plane of the structure that contains
/// r; without such a plane it is a side of the least rectangle around the projection along r. `band`:
/// fraction of the extent along r.
ContactFrame contact_frame(const ContactSituation& situation, double band);

/// One of the two surfaces of a contact region.
struct ContactSide {
  const ContactRegion& region;
  int row = 0;                ///< row of the region
  bool of_lower_copy = true;  ///< whether the surface belongs to the copy below
  int part = 0, other = 0;    ///< part of this surface, and part of the surface that it touches
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  bool on_end = false;  ///< whether the region lies on the top or bottom of the extent along r
};

/// Returns both sides of region `row`, the side of the copy below first.
std::vector<ContactSide> contact_sides(const ContactSituation& situation, int row, const ContactFrame& frame);

/// A sideways direction away from a contact.
struct ContactWay {
  Eigen::Vector3d along;  ///< unit vector
  EditEffect effect;      ///< outwards, inwards or sideways
};

/// Returns the sideways directions for a side, each with its opposite: radially and along u and v; for lines
/// only across the line. `near`: distance from the axis of the box within which a contact has no radial
/// direction, model units.
std::vector<ContactWay> ways_out(const ContactSide& side, const ContactFrame& frame, double near);

}  // namespace stackabilization::detail
