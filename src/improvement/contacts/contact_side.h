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
  double band = 0;          ///< what is this near to an end of `height` lies on it, model units

  bool on_end(const Range& along_w) const {
    return along_w.low <= height.low + band || along_w.high >= height.high - band;
  }
};

/// The first mirror plane of the structure that contains r gives u; without one the least rectangle around
/// the projection does. `band` is a fraction of the extent.
ContactFrame contact_frame(const ContactSituation& situation, double band);

/// One of the two surfaces that touch.
struct ContactSide {
  const ContactRegion& region;
  int row = 0;                ///< of the region
  bool of_lower_copy = true;  ///< this surface belongs to the copy below
  int part = 0, other = 0;    ///< of this surface, and of the one that it touches
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  bool on_end = false;  ///< on the top or bottom of the extent along r
};

/// Both sides of region `row`, that of the copy below first.
std::vector<ContactSide> contact_sides(const ContactSituation& situation, int row, const ContactFrame& frame);

/// A way out sideways.
struct ContactWay {
  Eigen::Vector3d along;  ///< unit
  std::string word;       ///< "outwards", "inwards", "sideways"
};

/// Both ways radially and along the sides of the box; for lines across them. `near`: a contact is on the axis
/// of the box, and goes nowhere radially, within this distance, model units.
std::vector<ContactWay> ways_out(const ContactSide& side, const ContactFrame& frame, double near);

}  // namespace stackabilization::detail
