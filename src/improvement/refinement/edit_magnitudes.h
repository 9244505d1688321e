#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/improvement/contact_edits.h"

namespace stackabilization::detail {

/// An edit with a variable magnitude.
struct MagnitudeEdit {
  Edit edit;
  std::optional<std::size_t> source;  ///< row of the given edit that it replaces; nothing for an added edit
};

/// Merges edits as `merge_edits` (refinement.h) and keeps the first source of each. Two edits are merged only
/// if the whole resulting list is `acceptable`, since the order of edits may matter.
std::vector<MagnitudeEdit> merge_magnitude_edits(
    const std::vector<Edit>& edits, const std::function<bool(const std::vector<MagnitudeEdit>&)>& acceptable);

/// Returns small edits that could be added to `edits`, only for models that edit primitives:
///
/// * parts: moves and scalings along the axes of the contact frame;
/// * faces of cuboids: moves along their normals;
/// * ends of open generalized cylinders, with Falloff::linear: moves across r, and scalings;
/// * where the wall of an open generalized cylinder has a profile: scalings of three sections between the
///   ends.
///
/// A class of symmetric parts is represented by its first part. A part that reaches an end of the extent
/// along r gets no edit along r. Of the smooth family only edits that are smooth. No edit repeats what one of
/// `edits` does.
std::vector<MagnitudeEdit> possible_edits(const std::vector<MagnitudeEdit>& edits,
                                          const DeformationModel& space, const Direction& direction,
                                          EditFamily family);

}  // namespace stackabilization::detail
