#pragma once

#include <limits>
#include <string>
#include <vector>

#include "stackabilization/deformation/edit.h"

/// Edits as people write them, one line each: a handle, then what is done to it.
///
///     HANDLE move X Y Z                    translation, model units
///     HANDLE rotate DEGREES about X Y Z    about the handle's centre
///     HANDLE scale FACTOR [along X Y Z]    about the handle's centre
///     shape taper FACTOR towards X Y Z [along X Y Z]    widths at the end that is highest along the axis
///     PART lean X Y Z towards X Y Z        moves the end of the part that is highest along the axis
///
/// The word `linearly` may end moves and scalings of cross-sections (Falloff).
///
/// HANDLE is one of PART, PART/face=F, PART/corner=0..7, PART/section=N, point=N, wire=N and shape. F is +x,
/// -x, +y, -y, +z or -z of the primitive's own axes, or 0 to 5 in the order -x, +x, -y, +y, -z, +z. A name
/// with blanks, or one that reads as something else ("shape", "wire=2", "a/face=1"), stands in single quotes;
/// a quote in it is doubled.
namespace stackabilization::apps {

/// An edit of a shape with these parts, whose bounding box has this diagonal. Throws UsageError naming the
/// edit, the word and what was expected there, also for numbers that `validate(edit, diagonal)` refuses.
Edit parse_edit(const std::string& text, const std::vector<std::string>& part_names,
                double diagonal = std::numeric_limits<double>::infinity());

/// The edit in that grammar: `parse_edit` gives it back, numbers to the last bit (angles to rounding, unless
/// they were parsed). Precondition: its part, where it has one, is a row of `part_names`.
std::string edit_text(const Edit& edit, const std::vector<std::string>& part_names);

/// A text for each edit.
std::vector<std::string> edit_texts(const std::vector<Edit>& edits,
                                    const std::vector<std::string>& part_names);

/// The handle alone.
std::string handle_text(const Handle& handle, const std::vector<std::string>& part_names);

}  // namespace stackabilization::apps
