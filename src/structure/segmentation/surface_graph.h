#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

/// Dual graph of the triangles, which all segmentation methods share.
namespace stackabilization::detail {

/// Two adjacent triangles.
struct SurfaceLink {
  std::int32_t a, b;
  /// Length of the shared edge, model units; 0 when they share only a point or only their position.
  double length;
  /// Angle between the normals, radians: positive across a convex edge, negative across a concave edge.
  double bend;
};

/// Graph with the triangles as nodes and adjacency as links.
struct SurfaceGraph {
  Eigen::VectorXd areas;  ///< areas of the triangles, model units squared
  Points centres;         ///< centroids of the triangles, model units
  /// Unit normals, outward where the orientation can be determined. Flat triangles have that of the surface
  /// beside their longest edge; other triangles without area have zero.
  Points normals;
  double diagonal = 0;  ///< diagonal of the bounding box of the triangles, model units
  std::vector<SurfaceLink> links;
  std::vector<std::vector<std::int32_t>> links_of;  ///< per triangle, rows of `links`

  /// Returns the number of triangles.
  std::int32_t size() const { return static_cast<std::int32_t>(areas.size()); }
  /// Returns the triangle at the other end of `link`.
  std::int32_t across(std::int32_t link, std::int32_t from) const {
    const SurfaceLink& l = links[static_cast<std::size_t>(link)];
    return l.a == from ? l.b : l.a;
  }
};

/// Builds the graph of all triangles, including degenerate ones. Triangles that are connected through common
/// points are connected in the graph: through edges first, and through points where no edge connects them.
/// Each piece of surface is oriented such that its volume, seen from its centre, is positive. The surface is
/// that of the first copies: a further triangle with the same corners, such as the back of a surface that was
/// drawn on both sides, belongs to its first copy and has the same normal.
SurfaceGraph surface_graph(const Shape& shape);

/// Links the shells of a graph in space. Each shell is linked to the larger shells, of which 64 count: at all
/// places within `reach` (model units) of one of them, or at its nearest triangle when there is no such
/// place.
void link_shells(SurfaceGraph& graph, const Shape& shape, double reach);

/// Adds links to a graph.
void add_links(SurfaceGraph& graph, const std::vector<SurfaceLink>& links);

/// Returns the triangles `rows` of `shape`, in their order, as a shape of one part.
Shape extracted(const Shape& shape, const std::vector<std::int32_t>& rows);

}  // namespace stackabilization::detail
