#pragma once

#include <vector>

#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

/// Returns which triangles of a surface belong to the body of revolution that most of it is, one flag each:
/// all of a mug but its handle. Empty where the surface is not connected, is no such body, or is one without
/// attachments. Attachments smaller than `smallest`, fraction of the area, count as the body, and so does
/// what does not stick out, such as the lip of a jug.
std::vector<char> revolution_body(const Shape& shape, const SurfaceGraph& graph, double smallest);

}  // namespace stackabilization::detail
