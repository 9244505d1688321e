#pragma once

#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/improvement/design.h"

namespace stackabilization {

/// Which edits a contact suggests.
enum class EditFamily {
  paper,     ///< section 4.2: faces, corners and cross-sections, one step
  extended,  ///< also whole parts, changes that stay linear along a cylinder (Falloff), and larger steps
};

/// Which edits `contact_edits` makes of contacts, and how large.
struct ContactEditOptions {
  EditFamily family = EditFamily::extended;  ///< what is taken hold of
  /// Cylinders whose axis is straight may bend, and walls that are cylinders or cones may bulge, as in the
  /// paper; otherwise their ends lean and widen with Falloff::linear, in either family.
  bool bends = false;
  double move_step = 0.06;  ///< fraction of the extent of the shape along the move; > 0
  double scale_step = 0.1;  ///< of a ring's handle, up and down; in (0, 1)
  /// Sizes of the extended family, as multiples of both steps; not empty, > 0, below 1 / scale_step.
  std::vector<double> multiples = {1, 3};
  /// Regions that are looked at, largest first, symmetric ones counted once; at least 1.
  int most_regions = 12;
  ContactOptions contacts;  ///< of the regions
};

/// One suggestion, and where it comes from.
struct ContactEdit {
  Edit edit;                            ///< to be made to the design
  ContactType type = ContactType::dot;  ///< of its region
  int region = 0;                       ///< row of the regions
  bool of_lower_copy = true;            ///< the edited side of the pair: the copy below, or the one above
  std::string why;                      ///< one clause: "down, away from what stands on it"
};

/// A design stacked on itself.
struct ContactSituation {
  const StructuredShape& rest;                ///< of the design space
  DeformationKind kind;                       ///< of the design space
  const std::vector<Handle>& handles;         ///< of the design space
  const Design& design;                       ///< the one that is stacked
  const std::vector<ContactRegion>& regions;  ///< of the design along the direction
  const Direction& direction;                 ///< r, from the copy below to the copy above
  /// DesignSpace::centres, for models without primitives; empty: only points are found, no wires or slices.
  std::vector<Eigen::Vector3d> centres = {};
};

/// Edits that separate the pairs of contact regions (paper, section 4.2), in the frame of r: a ring scales
/// the handle; a dot moves it along r (the side of the lower copy down, that of the upper copy up) or
/// sideways, out of the way; a line the same, but sideways only across the line. A region on the boundary of
/// the extent along r (to the width of the contact band) never moves along r. Sideways means radially (from
/// the axis of the shape's box along r), and along the sides of that box; where a mirror plane of the
/// structure contains r, its sides are along and across the first such plane.
///
/// The handle of a region is what lies nearest to its centre on the primitive of its part: face, and where
/// the region is near one corner, of a cuboid, cross-section of a cylinder; for models without primitives the
/// nearest point, wire and slice. Of cylinders that have to stay straight it is the nearest end. Gap scaling
/// has one edit, of the shape along r.
///
/// The extended family also takes hold of the ends of the part (faces of a cuboid across r; of cylinders with
/// Falloff::linear) and of the part as a whole, and scales
/// cross-sections, faces and wholes at dots and lines too, where the contact is off their centre. Sideways it
/// goes the shorter way past the other part and no farther than that takes; the longer way is tried with the
/// nearest handle and the least multiple only. Along r, where most stands in the way, half of the least
/// multiple is tried too. Plates (cuboids thin along the contact) do not move or scale by the face that is
/// touched: their edges draw back from the contact.
///
/// Edits that a self-symmetry rules out are left out, such as moves of a handle across the mirror plane that
/// it lies on. Of regions that symmetries of the structure take onto each other the first stands for all,
/// since edits are symmetric (but for the surface model, whose edits are not). Every edit occurs once.
/// Deterministic; order: by region, side (the copy below first), handle, kind, size. Throws UsageError for
/// options out of range.
std::vector<ContactEdit> contact_edits(const ContactSituation& situation,
                                       const ContactEditOptions& options = {});

}  // namespace stackabilization
