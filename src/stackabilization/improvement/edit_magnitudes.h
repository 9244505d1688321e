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

/// The same operations on the handles opposite to those of `edits`, where there is such a handle and nothing
/// does the same there already: the other end of an open generalized cylinder, the opposite face of a cuboid.
/// What one end takes away the other can give back.
std::vector<MagnitudeEdit> counterparts(const std::vector<MagnitudeEdit>& edits, const DesignSpace& space);

}  // namespace stackabilization::detail
