#pragma once

#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/envelope/contacts.h"

namespace stackabilization {

/// Families of edits that contacts suggest.
enum class EditFamily {
  paper,     ///< section 4.2 of the paper: faces, corners and cross-sections, one step
  extended,  ///< also ends of parts (with Falloff::linear) and whole parts, and larger steps
  smooth,    ///< the extended family without edits that bend, bulge or slant a part: see `is_smooth`
};

/// Returns whether an edit of a part with this primitive keeps straight members straight, flat faces flat and
/// profiles even: all edits of whole parts; edits of the ends of a straight generalized cylinder with
/// Falloff::linear; moves of a face of a cuboid along its normal, and all edits of the two ends of a cuboid
/// that is at least 3 times as long as wide. Other models than controllers have no smooth edits.
bool is_smooth(const Edit& edit, const Primitive& primitive);

/// Options of `contact_edits`.
struct ContactEditOptions {
  EditFamily family = EditFamily::extended;  ///< family of handles and edits
  /// Whether cylinders with a straight axis may bend, and cylindrical or conical walls may bulge, as in the
  /// paper. If not, edits lean or widen the ends of such cylinders with Falloff::linear, in both families.
  bool bends = false;
  double move_step = 0.06;  ///< step of a move, fraction of the extent of the shape along the move; > 0
  double scale_step = 0.1;  ///< step of a scaling: factors 1 - step and 1 + step; in (0, 1)
  /// Sizes of the edits of the extended family, as multiples of the two steps; not empty, > 0, below 1 /
  /// scale_step.
  std::vector<double> multiples = {1, 3};
  /// Largest number of regions considered, largest area first; symmetric regions count once; >= 1.
  int max_regions = 12;
  ContactOptions contacts;  ///< options of the contact regions; `band` also defines the ends of the extent
};

/// What an edit does about a contact.
enum class EditEffect {
  down,          ///< moves against r
  up,            ///< moves along r
  outwards,      ///< moves away from the axis of the shape
  inwards,       ///< moves towards the axis of the shape
  sideways,      ///< moves across r, neither outwards nor inwards
  edge_inwards,  ///< moves an edge face of a plate inwards
  narrower,      ///< shrinks across r
  wider,         ///< grows across r
  flatter,       ///< shrinks along r
  squash,        ///< gap scaling: moves everything below the upper envelope up
  compensation,  ///< no contact suggests it: it makes up for the other edits
};

/// Reason of an edit.
struct EditReason {
  EditEffect effect = EditEffect::compensation;  ///< what the edit does
  bool leaning = false;                          ///< whether the moved end leans, with Falloff::linear
  int away_from = -1;  ///< row of Structure::parts that is avoided; -1: the same part of the next copy

  bool operator==(const EditReason&) const = default;  ///< compares all members
};

/// Returns a reason as one clause: "down, away from the next copy". Throws std::out_of_range when there is no
/// such part.
std::string describe(const EditReason& reason, const std::vector<std::string>& part_names);

/// An edit that a contact region suggests.
struct ContactEdit {
  Edit edit;                            ///< edit to make to the design
  ContactType type = ContactType::dot;  ///< type of the region
  int region = 0;                       ///< row of the region in ContactSituation::regions
  bool of_lower_copy = true;            ///< edited side of the region: the copy below, or the copy above
  EditReason reason;                    ///< what it does, and what it avoids
};

/// A design stacked on itself, with its contacts.
struct ContactSituation {
  const StructuredShape& rest;                ///< shape at rest of the deformation model
  DeformationCapabilities capabilities;       ///< those of the deformation model
  const std::vector<Handle>& handles;         ///< handles of the deformation model
  const Design& design;                       ///< design that is stacked
  const std::vector<ContactRegion>& regions;  ///< contact regions of the design along `direction`
  const Direction& direction;                 ///< r, from the copy below to the copy above
  /// DeformationModel::centres, for models that do not edit primitives. If empty, only points are used as
  /// handles, no wires and no slices.
  std::vector<Eigen::Vector3d> centres = {};
};

/// Returns the edits that separate the two sides of contact regions (paper, section 4.2).
///
/// Frame: w = r / |r|. Where a mirror plane of the structure contains r, u is the normal of the first such
/// plane; otherwise u and v are the sides of the least rectangle around the projection along r. Radial moves
/// go away from or towards the axis along r through the centre of the shape's box in this frame.
///
/// Handles of one side of a region; (E) marks what only the extended family has:
///
/// | role | handle |
/// | --- | --- |
/// | nearest | cuboid: the nearest face, and the nearest corner if the contact is near one |
/// | | generalized cylinder: the nearest cross-section, or the nearest end if it has to stay straight |
/// | | smooth family: the nearer end of the part that is widest across r, if that is round about r |
/// | | models that do not edit primitives: the nearest point, wire and slice |
/// | end (E) | cuboid: the faces across r; generalized cylinder: both end sections, with Falloff::linear |
/// | whole (E) | the part |
///
/// Edits by role and type of region:
///
/// | role | ring | dot | line |
/// | --- | --- | --- | --- |
/// | nearest | scale; along r (E) | along r; sideways; scale (E) | along r; across; scale (E) |
/// | end (E) | scale | sideways; scale | across; scale |
/// | whole (E) | along r; scale | along r; sideways; scale | along r; across; scale |
///
/// * Along r: a move down on the copy below, up on the copy above. Left out where the region or the handle
///   lies on the boundary of the extent along r, to the width of the contact band. The extended family also
///   tries half of the smallest size.
/// * Sideways: moves along u, along v and radially, both ways. Across: only across the line, both ways.
/// * Sizes sideways and across, next to another part of the copy (E): on the shorter way past the other part
///   the multiples below the distance that clears it (with the contact band as margin), that distance, and
///   1.5 times that distance; the plain multiples where that distance is not within 0.2 to 6 steps. On the
///   longer way only the smallest size of nearest handles.
/// * Scale a cross-section, wire, slice or face: narrower and wider within its plane. At rings always; at
///   dots and lines only cross-sections and faces of controllers, where the contact is off their centre. All
///   sizes, except that only the smallest is used to widen at dots and lines and for sections that bulge
///   (Falloff::gaussian).
/// * Scale a part: narrower and wider along u and v, flatter along w. Along u and v at rings always; else,
///   and along w, only where the contact is off the centre of the part. Not along a line. Not along w if the
///   part reaches an end of the extent. Narrower by the sizes below the one that clears the other part, and
///   that one; wider by the smallest size.
/// * Plates (cuboids thin along the contact, E): the touched face moves along r only. The two edge faces on
///   the side of the contact draw back from it, if their normals lie across r.
/// * The whole shape, with the largest region (smooth family): tapers towards either end along r, narrower
///   and wider; in both widths, and where the widest part is not round about r also in u or v alone.
/// * Gap scaling: one edit, the scaling of the shape along r.
///
/// Edits that a self-symmetry forbids are left out, for instance moves of a handle across a mirror plane on
/// which it lies. Regions that symmetries of the structure map onto each other are represented by the first
/// one, since edits are symmetric; not so for the surface model, whose edits are not symmetric.
///
/// Every edit occurs once. Deterministic. Order: by region, side (the copy below first), handle, kind, size.
/// Throws UsageError for options out of range.
std::vector<ContactEdit> contact_edits(const ContactSituation& situation,
                                       const ContactEditOptions& options = {});

}  // namespace stackabilization
