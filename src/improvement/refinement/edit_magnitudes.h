#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "stackabilization/improvement/design.h"

namespace stackabilization::detail {

/// An edit whose magnitude is looked for.
struct MagnitudeEdit {
  Edit edit;
  std::optional<std::size_t> source;  ///< row of the edit given that it stands for; of a counterpart nothing
};

/// As `merged` (refinement.h), with the first source of each; but two edits become one only where the whole
/// list that this gives is acceptable, since their order may matter.
std::vector<MagnitudeEdit> merged_edits(
    const std::vector<Edit>& edits, const std::function<bool(const std::vector<MagnitudeEdit>&)>& acceptable);

/// What may join `edits`, in small, of a controller model: moves and scalings of every part along the axes of
/// the contacts; moves of the faces of cuboids, in and out; of the ends of open generalized cylinders, with
/// Falloff::linear, moves across r and scalings; where the wall has a profile, scalings of three sections
/// between them. Of symmetric parts the first stands for all. Nothing along r of a part at an end of the
/// shape, nothing that one of `edits` does already, nothing for other models.
std::vector<MagnitudeEdit> possible_edits(const std::vector<MagnitudeEdit>& edits, const DesignSpace& space,
                                          const Direction& direction);

}  // namespace stackabilization::detail
