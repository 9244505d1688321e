#pragma once

#include <string>
#include <vector>

#include "stackabilization/envelope/contacts.h"
#include "stackabilization/improvement/design.h"
#include "stackabilization/shape/direction.h"

namespace stackabilization {

/// Which edits a contact suggests.
enum class EditFamily {
  paper,     ///< section 4.2: faces, corners and cross-sections, one step
  extended,  ///< also whole parts, changes that stay linear along a cylinder (Falloff), and larger steps
};

struct ContactEditOptions {
  EditFamily family = EditFamily::extended;
  double move_step = 0.06;  ///< fraction of the extent of the shape along the move; > 0
  double scale_step = 0.1;  ///< of a ring's handle, up and down; in (0, 1)
  /// Further sizes of the extended family, as multiples of both steps.
  std::vector<double> multiples = {1, 3};
  /// Regions that are looked at, largest first, symmetric ones counted once; at least 1.
  int most_regions = 12;
  ContactOptions contacts;
};

/// One suggestion, and where it comes from.
struct ContactEdit {
  Edit edit;
  ContactType type = ContactType::dot;
  int region = 0;             ///< row of the regions
  bool of_lower_copy = true;  ///< the edited side of the pair: the copy below, or the one above
  std::string why;            ///< one clause: "down, away from what stands on it"
};

/// A design stacked on itself.
struct ContactSituation {
  const StructuredShape& rest;
  DeformationKind kind;
  const std::vector<Handle>& handles;  ///< of the design space
  const Design& design;
  const std::vector<ContactRegion>& regions;  ///< of the design along the direction
  const Direction& direction;
};

/// Edits that separate the pairs of contact regions (paper, section 4.2), in the frame of r: a ring scales
/// the handle; a dot moves it along r (the side of the lower copy down, that of the upper copy up) or
/// sideways, out of the way; a line the same, but sideways only across the line. A region on the boundary of
/// the extent along r never moves along r. Sideways means radially (from the axis of the shape's box along
/// r), and along the sides of that box.
///
/// The handle of a region is what lies nearest to its centre on the primitive of its part: face or corner of
/// a cuboid, cross-section of a cylinder; for models without primitives the nearest point, wire or slice. Of
/// regions that symmetries of the structure take onto each other the first stands for all, since edits are
/// symmetric. Every edit occurs once. Deterministic; order: by region, side, handle, kind, size.
std::vector<ContactEdit> contact_edits(const ContactSituation& situation,
                                       const ContactEditOptions& options = {});

}  // namespace stackabilization
