#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/improvement/contact_edits.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Ways in which the form or the place of a part changes. Ratios are those of a size to that at rest, less 1.
enum class FormChangeKind {
  lean,       ///< change of the direction of an upright part, degrees
  tilt,       ///< change of the slope of a part that is not upright, degrees
  turn,       ///< rotation about the upright axis, degrees
  rise,       ///< move up (> 0) or down, of the height of the object
  shift,      ///< level move, of the height of the object
  size,       ///< ratio of all sizes, or of both sizes of a plate within its plane
  girth,      ///< ratio of both level sizes
  width,      ///< ratio of a size across
  length,     ///< ratio of the length
  tallness,   ///< ratio of the upright size
  thickness,  ///< ratio of the thickness of a plate or a member
  upper_end,  ///< ratio of the thickness of an upright member, or body, at its upper end
  lower_end,  ///< the same at its lower end
  one_end,    ///< ratio of the thickness of another member at one end
  rim,        ///< ratio of the width of an open vessel at its upper end: root of that of the area
  foot,       ///< the same at its lower end
  bend,       ///< departure of a straight member from its chord, of the height of the object
  form,       ///< largest distance of any other part from an affine image of itself, of the height
};

/// Where a part moves or leans to.
enum class Heading {
  none,      ///< for kinds other than lean and shift
  outwards,  ///< away from the upright axis of the object, within 60 degrees
  inwards,   ///< towards that axis, within 60 degrees
  sideways,  ///< neither; also near the axis
};

/// One change of a part.
struct FormChange {
  FormChangeKind kind = FormChangeKind::rise;  ///< what changed
  double amount = 0;                           ///< by how much; the kind defines unit and sign
  Heading heading = Heading::none;             ///< of `lean` and `shift`
};

/// Returns the name of a kind: that of its enumerator with "-" for "_".
std::string name_of(FormChangeKind kind);
/// Returns the name of a heading: that of its enumerator.
std::string name_of(Heading heading);
/// Returns the unit of an amount: "degrees", "of the height" or "of rest".
std::string unit_of(FormChangeKind kind);

/// Parts that changed alike.
struct GroupChange {
  std::vector<int> parts;            ///< rows of Shape::part_names, ascending
  std::string name;                  ///< "4 legs", "middle bar": from the names of the parts, or their form
  bool plural = false;               ///< whether `name` is a plural
  std::vector<FormChange> changes;   ///< in the order of FormChangeKind
  double displacement = 0;           ///< largest displacement of a point of the parts, of the diagonal
  bool edited = false;               ///< whether an edit names a part of the group or one symmetric to it
  std::vector<std::string> cleared;  ///< names of what the edits avoid: "the seat of the next copy"
  std::vector<int> followers;        ///< parts that move along rigidly, ascending
  std::string followers_name;        ///< their name, as `name`
};

/// A change of an object as a person describes it.
struct Explanation {
  std::vector<GroupChange> groups;  ///< by displacement, largest first
  double diagonal = 0;              ///< of the object at rest, model units
  double height = 0;                ///< of the object at rest along `up`, model units
  Unit unit = Unit::unknown;        ///< of the object at rest
};

/// What is known of a change beside the two shapes.
struct ExplanationOptions {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< direction against gravity
  std::vector<Edit> edits;                        ///< edits that made the change; may be empty
  std::vector<EditReason> reasons;                ///< one reason per edit, or empty
};

/// Describes the change of an object part by part. Everything is measured on the mesh, whatever changed it:
/// each part by its best affine map, straight members by their centre lines and the radii at their ends.
///
/// Parts are in one group if they are symmetric or have one noun, and changed alike. A part is left out if no
/// point of it moved by tolerance::visible of the diagonal. A change is left out if it moves no
/// surface so far; ratios count from tolerance::explanation::ratio on also where they move less. A change is
/// left out too if some change of the object is seen more than seven times better, unless it is the one of
/// its part that is seen best.
///
/// The place of a part is that of its point that moves least, so a part that only leans or grows from a fixed
/// end is neither moved nor raised. Displacements are relative to the ground and, in level directions, to the
/// part to which the others (by area) move least; so an object that was moved as a whole has no groups. An
/// object that changed by one affine map is one group, named "whole object".
///
/// A leaning member that stands on the ground leans to where its lower end goes relative to its upper end:
/// legs that lean outwards have their feet further out. Any other leans to where the end goes that moves
/// most.
///
/// Deterministic; poses about `up` and scales make no difference beyond rounding. Throws UsageError when
/// `now` does not have the triangles and parts of the object at rest, InputError under the conditions of
/// `validate(rest)`.
Explanation explain(const StructuredShape& rest, const Shape& now, const ExplanationOptions& options = {});

/// Returns one change in words, such as "lean outwards by 6.2 degrees" or "4 cm higher". Lengths are in the
/// unit in which a person reads them (readable_unit), or in per cent of the height where the object has none.
/// Numbers have two significant digits. `plural`: the form of the verb.
std::string describe(const FormChange& change, const Explanation& explanation, bool plural);

/// Returns the line of a group, such as "4 legs lean outwards by 6.2 degrees, 2 % longer".
std::string describe(const GroupChange& group, const Explanation& explanation);

/// Returns the lines of a change: the first groups, and where there are more than `max_lines` of them, what
/// is left in one line such as "and 3 more parts by less than 1 % of the height". Empty without groups.
/// Precondition: max_lines >= 1.
std::vector<std::string> lines(const Explanation& explanation, std::size_t max_lines = 6);

}  // namespace stackabilization
