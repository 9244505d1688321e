#pragma once

#include <vector>

#include "stackabilization/structure/segmentation.h"

namespace stackabilization::editing {

/// Segments anew those parts of `shape` in which there are strokes (after Meng et al. 2011): each of their
/// triangles joins the part with the nearest stroke. Other parts stay. A stroke of a new name makes a new
/// part, one of an existing name adds to that part. Parts that lose all triangles are left out.
///
/// Throws UsageError for strokes without triangles or without a name, triangles that do not exist or are in
/// strokes of two names, and a part in which all strokes have one name that is not its own: nobody would know
/// what stays.
Shape segment_by_strokes(const Shape& shape, const std::vector<PartSeeds>& strokes);

}  // namespace stackabilization::editing
