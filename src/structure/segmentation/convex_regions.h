#pragma once

#include <cstdint>
#include <vector>

#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

/// Conditions of `convex_regions`.
struct ConvexRegionRule {
  /// Angle between the normals across a concave edge from which on the edge bounds a region, degrees: shapes
  /// with rounded concave edges have none.
  double min_bend = 20;
  /// Largest share of all edges that are such and lie inside regions: rough surfaces have them everywhere.
  double max_inside = 0.15;
  /// Least share of the solid behind a region that ends at another one, where the two are one region: the
  /// inner and the outer side of a vessel, or the top of a table and its underside between the rails.
  double min_shared_wall = 0.5;
  /// Least share of the surface with an end of the solid behind it. Sheets have no concave side.
  double min_solid = 0.5;
  /// A shape of more regions, such as a basket of fused wires, has none.
  int max_regions = 64;
};

/// Returns whether any edge bends inwards by `min_bend` of the rule or more.
bool has_sharp_concave_edges(const SurfaceGraph& graph, const ConvexRegionRule& rule = {});

/// Returns the region of every triangle, from 0: what sharp concave edges bound all around (the minima rule,
/// Hoffman and Richards 1984). The union of convex bodies has one region per body that is not flush with
/// another one, and one more per side of a body that others hide from each other. Returns all zeros for rough
/// surfaces.
std::vector<std::int32_t> convex_regions(const SurfaceGraph& graph, const ConvexRegionRule& rule = {});

/// Returns those of `walls`, from `wall_links`, that begin at an inner side: a region of at least `min_area`
/// (model units squared) behind which the solid ends at another region, as behind the floor of a box.
std::vector<SurfaceLink> inner_walls(const SurfaceGraph& graph, const std::vector<std::int32_t>& regions,
                                     const std::vector<SurfaceLink>& walls, double min_area,
                                     const ConvexRegionRule& rule = {});

/// Joins every region to the one at which most of the solid behind it ends, until there is none to join.
/// Regions smaller than `min_area` (model units squared) join a neighbour. Returns the regions numbered anew,
/// and all zeros where there are none. `walls`: from `wall_links`.
std::vector<std::int32_t> joined_across_walls(const SurfaceGraph& graph, std::vector<std::int32_t> regions,
                                              const std::vector<SurfaceLink>& walls, double min_area,
                                              const ConvexRegionRule& rule = {});

/// Gives each inner side to the piece at which most of the solid behind it ends. `pieces` and `regions`:
/// numbers from 0, one per triangle.
std::vector<std::int32_t> with_inner_sides(std::vector<std::int32_t> pieces,
                                           const std::vector<std::int32_t>& regions,
                                           const std::vector<SurfaceLink>& inner_walls,
                                           const ConvexRegionRule& rule = {});

/// Builds the graph of a shape with links between its shells where they touch, and through the walls at its
/// inner sides. `smallest`: area of the smallest inner side, fraction of the whole.
SurfaceGraph linked_surface_graph(const Shape& shape, double smallest);

}  // namespace stackabilization::detail
