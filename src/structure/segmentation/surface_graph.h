#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

/// Not installed: what the segmentations share.
namespace stackabilization::detail {

/// Two triangles side by side.
struct SurfaceLink {
  std::int32_t a, b;
  double length;  ///< of the shared edge, model units; 0 where they share a point or nothing but their place
  double bend;    ///< angle between the normals in radians, positive across a convex edge, negative across a
                  ///< concave one
};

/// Triangles as nodes, neighbourhood as links.
struct SurfaceGraph {
  Eigen::VectorXd areas;  ///< model units squared
  Points centres;         ///< of the triangles
  Points normals;         ///< unit and outward as far as that can be told; zero where the area is
  double diagonal = 0;    ///< of the bounding box of the triangles, model units
  std::vector<SurfaceLink> links;
  std::vector<std::vector<std::int32_t>> links_of;  ///< per triangle rows of `links`

  std::int32_t size() const { return static_cast<std::int32_t>(areas.size()); }
  std::int32_t across(std::int32_t link, std::int32_t from) const {
    const SurfaceLink& l = links[static_cast<std::size_t>(link)];
    return l.a == from ? l.b : l.a;
  }
};

/// The graph of all triangles, degenerate ones included. It is connected where the triangles are through
/// common points: across edges first, across points where no edge does. A piece of surface is turned so that
/// its volume seen from its centre is positive.
SurfaceGraph surface_graph(const Shape& shape);

/// Joins the shells of a graph that belong together in space: each is linked to the largest one where it lies
/// within `reach` (model units) of it, at its nearest triangle otherwise.
void link_shells(SurfaceGraph& graph, const Shape& shape, double reach);

/// Rows of `shape`, in their order, as a shape of one part.
Shape extracted(const Shape& shape, const std::vector<std::int32_t>& rows);

}  // namespace stackabilization::detail
