#include "structure/segmentation/convex_regions.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/index.h"
#include "structure/segmentation/chords.h"
#include "structure/segmentation/components.h"
#include "structure/segmentation/segment_boundaries.h"

namespace stackabilization::detail {

using Pieces = std::vector<std::int32_t>;

namespace {

std::size_t count_of(const Pieces& pieces) {
  return static_cast<std::size_t>(*std::max_element(pieces.begin(), pieces.end())) + 1;
}

/// Returns for every region the piece at which at least the share `min_share` of the solid behind it ends,
/// and -1 where there is none.
Pieces ends_of(const Pieces& regions, const Pieces& pieces, const std::vector<SurfaceLink>& walls,
               double min_share) {
  std::vector<double> all(count_of(regions), 0);
  std::map<std::pair<std::int32_t, std::int32_t>, double> shared;
  for (const SurfaceLink& wall : walls) {
    ++all[at(regions[at(wall.a)])];
    ++shared[{regions[at(wall.a)], pieces[at(wall.b)]}];
  }
  Pieces ends(all.size(), -1);
  for (const auto& [pair, count] : shared)
    if (count >= min_share * all[at(pair.first)]) ends[at(pair.first)] = pair.second;
  return ends;
}

bool is_sharp(const SurfaceLink& link, const ConvexRegionRule& rule) {
  return link.bend <= -rule.min_bend * std::numbers::pi / 180;
}

}  // namespace

bool has_sharp_concave_edges(const SurfaceGraph& graph, const ConvexRegionRule& rule) {
  return std::any_of(graph.links.begin(), graph.links.end(),
                     [&](const SurfaceLink& link) { return is_sharp(link, rule); });
}

Pieces convex_regions(const SurfaceGraph& graph, const ConvexRegionRule& rule) {
  DisjointSets sets(static_cast<std::size_t>(graph.size()));
  for (const SurfaceLink& link : graph.links)
    if (!is_sharp(link, rule)) sets.join(at(link.a), at(link.b));
  Pieces regions = sets.numbers();
  double all = 0, inside = 0;
  for (const SurfaceLink& link : graph.links) {
    all += link.length;
    if (is_sharp(link, rule) && regions[at(link.a)] == regions[at(link.b)]) inside += link.length;
  }
  if (inside > rule.max_inside * all) std::fill(regions.begin(), regions.end(), 0);
  return regions;
}

std::vector<SurfaceLink> inner_walls(const SurfaceGraph& graph, const Pieces& regions,
                                     const std::vector<SurfaceLink>& walls, double min_area,
                                     const ConvexRegionRule& rule) {
  const Pieces ends = ends_of(regions, regions, walls, rule.min_shared_wall);
  std::vector<double> areas(ends.size(), 0);
  for (std::size_t t = 0; t < regions.size(); ++t)
    areas[at(regions[t])] += graph.areas(static_cast<Eigen::Index>(t));
  std::vector<SurfaceLink> inner;
  for (const SurfaceLink& wall : walls) {
    const std::int32_t region = regions[at(wall.a)];
    if (ends[at(region)] >= 0 && ends[at(region)] != region && areas[at(region)] >= min_area)
      inner.push_back(wall);
  }
  return inner;
}

Pieces joined_across_walls(const SurfaceGraph& graph, Pieces regions, const std::vector<SurfaceLink>& walls,
                           double min_area, const ConvexRegionRule& rule) {
  if (static_cast<double>(walls.size()) < rule.min_solid * wall_places) return Pieces(regions.size(), 0);
  SurfaceGraph through_walls = graph;
  add_links(through_walls, inner_walls(graph, regions, walls, min_area, rule));
  for (bool changed = true; changed;) {
    const Pieces ends = ends_of(regions, regions, walls, rule.min_shared_wall);
    DisjointSets sets(ends.size());
    for (std::size_t region = 0; region < ends.size(); ++region)
      if (ends[region] >= 0) sets.join(region, at(ends[region]));
    changed = sets.count() < ends.size();
    const Pieces numbers = sets.numbers();
    for (std::int32_t& region : regions) region = numbers[at(region)];
  }
  regions = merge_small_segments(through_walls, regions, min_area);
  return count_of(regions) > static_cast<std::size_t>(rule.max_regions) ? Pieces(regions.size(), 0) : regions;
}

Pieces with_inner_sides(Pieces pieces, const Pieces& regions, const std::vector<SurfaceLink>& inner_walls,
                        const ConvexRegionRule& rule) {
  const Pieces ends = ends_of(regions, pieces, inner_walls, rule.min_shared_wall);
  for (std::size_t t = 0; t < pieces.size(); ++t)
    if (const std::int32_t end = ends[at(regions[t])]; end >= 0) pieces[t] = end;
  return pieces;
}

SurfaceGraph linked_surface_graph(const Shape& shape, double smallest) {
  SurfaceGraph graph = surface_graph(shape);
  const double area = graph.areas.sum();
  if (!(area > 0)) return graph;
  const std::vector<SurfaceLink> walls =
      inner_walls(graph, convex_regions(graph), wall_links(shape, graph), smallest * area);
  link_shells(graph, shape, ContactRule().reach * graph.diagonal);
  add_links(graph, walls);
  return graph;
}

}  // namespace stackabilization::detail
