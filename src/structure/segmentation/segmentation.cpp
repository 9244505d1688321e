#include "stackabilization/structure/segmentation.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/bounding_diagonal.h"
#include "core/extract_parts.h"
#include "mesh/surface_moments.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/part_names.h"
#include "stackabilization/structure/fitting.h"
#include "structure/fitting/revolution_axis.h"
#include "structure/model/fit_error.h"
#include "structure/segmentation/chords.h"
#include "structure/segmentation/components.h"
#include "structure/segmentation/convex_regions.h"
#include "structure/segmentation/flat_triangles.h"
#include "structure/segmentation/hierarchical_fitting.h"
#include "structure/segmentation/members.h"
#include "structure/segmentation/revolution_body.h"
#include "structure/segmentation/rod_lattice.h"
#include "structure/segmentation/segment.h"
#include "structure/segmentation/segment_boundaries.h"
#include "structure/segmentation/shape_diameter.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization {

namespace {

void check(const SegmentationOptions& options) {
  if (options.parts < 0) throw UsageError("the number of parts per component must not be negative");
  if (!(options.min_part_area >= 0 && options.min_part_area < 1))
    throw UsageError("the share of the smallest part must be at least 0 and below 1");
}

std::int32_t count_of(const std::vector<std::int32_t>& part) {
  return *std::max_element(part.begin(), part.end()) + 1;
}

/// `shape` with the parts of `part`, a number per triangle, by falling area; equal ones by their first
/// triangles.
Shape with_parts_by_area(const Shape& shape, const std::vector<std::int32_t>& part) {
  const auto count = static_cast<std::size_t>(count_of(part));
  if (count == 1 && shape.part_count() == 1) return shape;
  std::vector<double> area(count, 0);
  std::vector<std::size_t> first(count, part.size());
  for (std::size_t t = part.size(); t-- > 0;) {
    const auto row = static_cast<Eigen::Index>(t);
    area[static_cast<std::size_t>(part[t])] += detail::area_vector(shape, row).stableNorm();
    first[static_cast<std::size_t>(part[t])] = t;
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return area[a] != area[b] ? area[a] > area[b] : first[a] < first[b];
  });
  std::vector<std::int32_t> rank(count);
  Shape result = shape;
  result.part_names.clear();
  for (std::size_t k = 0; k < count; ++k) {
    rank[order[k]] = static_cast<std::int32_t>(k);
    result.part_names.push_back("part_" + std::to_string(k + 1));
  }
  for (std::size_t t = 0; t < part.size(); ++t)
    result.triangle_part[t] = rank[static_cast<std::size_t>(part[t])];
  return result;
}

/// Cuts every piece of a shape by itself, and returns a number per triangle, from 0.
std::vector<std::int32_t> cut_each(const Shape& shape, const std::vector<std::int32_t>& piece,
                                   const detail::CutIntoPieces& cut) {
  std::vector<std::vector<std::int32_t>> rows(static_cast<std::size_t>(count_of(piece)));
  for (std::size_t t = 0; t < piece.size(); ++t)
    rows[static_cast<std::size_t>(piece[t])].push_back(static_cast<std::int32_t>(t));
  std::vector<std::int32_t> part(piece.size());
  std::int32_t next = 0;
  for (const std::vector<std::int32_t>& of_piece : rows) {
    const std::vector<std::int32_t> pieces = cut(detail::extracted(shape, of_piece));
    for (std::size_t k = 0; k < of_piece.size(); ++k)
      part[static_cast<std::size_t>(of_piece[k])] = next + pieces[k];
    next += count_of(pieces);
  }
  return part;
}

/// Makes `body`, one flag per triangle or empty, a part of its own, whatever the clusters are: a handle that
/// goes down to the foot of its mug does not take the foot along.
void keep_together(const std::vector<char>& body, std::vector<std::int32_t>& part) {
  const std::int32_t number = count_of(part);
  for (std::size_t t = 0; t < body.size(); ++t)
    if (body[t]) part[t] = number;
}

/// One generalized cylinder represents a body of revolution, whatever its profile. A cut, such as that of a
/// hat into crown and brim, would only add joints.
bool is_body_of_revolution(const Shape& shape) {
  return detail::surface_graph(shape).areas.sum() > 0 &&
         detail::revolution_axis(detail::FitSurface(shape)).has_value();
}

/// What cuts a component first.
enum class CutsBy { concave_edges, fitting };

/// Cuts components of surfaces. What is large or small is so against the component.
class ComponentCutter {
 public:
  ComponentCutter(const Shape& component, const SegmentationOptions& options)
      : component_(component), options_(options), graph_(detail::surface_graph(component)) {
    whole_ = {graph_.areas.sum(), graph_.diagonal};
    min_area_ = options.min_part_area * whole_.area;
  }

  /// Returns a number per triangle. Concave edges and walls do not count where a number of parts or thickness
  /// does.
  std::vector<std::int32_t> run(CutsBy by) {
    if (!(whole_.area > 0)) return std::vector<std::int32_t>(static_cast<std::size_t>(graph_.size()), 0);
    if (options_.method == SegmentationMethod::shape_diameter) {
      link_shells(graph_, component_);
      return tidied(graph_, detail::shape_diameter_parts(component_, graph_, options_.parts));
    }
    // A step in the profile of a body of revolution, such as a foot ring, is a concave edge all around.
    if (options_.parts > 0 || by == CutsBy::fitting || is_body_of_revolution(component_))
      return tidied(graph_, fit(component_, graph_));
    const std::vector<detail::SurfaceLink> walls = detail::wall_links(component_, graph_);
    const std::vector<std::int32_t> regions = detail::convex_regions(graph_);
    const std::vector<std::int32_t> bodies = detail::joined_across_walls(graph_, regions, walls, min_area_);
    const std::vector<detail::SurfaceLink> inner_walls =
        detail::inner_walls(graph_, regions, walls, min_area_);
    std::vector<std::int32_t> part =
        count_of(bodies) == 1
            ? fit(component_, graph_)
            : cut_each(component_, bodies, [&](const Shape& body) { return cut_body(body); });
    detail::add_links(graph_, inner_walls);
    return tidied(graph_, detail::with_inner_sides(std::move(part), regions, inner_walls));
  }

 private:
  static void link_shells(detail::SurfaceGraph& graph, const Shape& shape) {
    detail::link_shells(graph, shape, detail::ContactRule().reach * graph.diagonal);
  }

  /// Returns clusters with boundaries along concave edges, and none smaller than a part may be.
  std::vector<std::int32_t> tidied(const detail::SurfaceGraph& graph, std::vector<std::int32_t> part) const {
    part = detail::with_smooth_boundaries(graph, std::move(part), {});
    return detail::merge_small_segments(graph, part, min_area_);
  }

  /// Returns the clusters that fit primitives: so many if a number is given.
  std::vector<std::int32_t> fit(const Shape& shape, detail::SurfaceGraph& graph) const {
    const std::vector<char> body = options_.parts == 0
                                       ? detail::revolution_body(shape, graph, options_.min_part_area)
                                       : std::vector<char>();
    link_shells(graph, shape);
    std::vector<std::int32_t> part =
        detail::fitted_parts(shape, graph, options_.parts, options_.min_part_area, whole_);
    keep_together(body, part);
    return part;
  }

  /// Cuts what concave edges bound as the component would be cut, and what is left of it into members.
  std::vector<std::int32_t> cut_body(const Shape& body) const {
    detail::SurfaceGraph graph = detail::surface_graph(body);
    std::vector<std::int32_t> part(static_cast<std::size_t>(graph.size()), 0);
    if (!(graph.areas.sum() > 0) || detail::is_small(body, whole_.diagonal) ||
        !detail::may_have_members(fit_primitive(body), rule_for(graph)))
      return part;
    part = fit(body, graph);
    part = tidied(graph, std::move(part));
    return cut_each(body, part, [&](const Shape& piece) {
      if (detail::is_small(piece, whole_.diagonal))
        return std::vector<std::int32_t>(piece.triangle_part.size(), 0);
      const auto fitted = [&](const Shape& of) { return ComponentCutter(of, options_).run(CutsBy::fitting); };
      return detail::members(piece, fitted, rule_for(detail::surface_graph(piece)));
    });
  }

  /// A piece with sharp concave edges, such as bars with flush faces, may have members however well one
  /// primitive represents it.
  static detail::MemberRule rule_for(const detail::SurfaceGraph& graph) {
    detail::MemberRule rule;
    if (detail::has_sharp_concave_edges(graph)) rule.misfit = 0;
    return rule;
  }

  const Shape& component_;
  const SegmentationOptions& options_;
  detail::SurfaceGraph graph_;
  detail::WholeSize whole_{};
  double min_area_ = 0;
};

Shape cut_components(const Shape& shape, const std::vector<std::int32_t>& component,
                     const SegmentationOptions& options, CutsBy by) {
  return with_parts_by_area(shape, cut_each(shape, component, [&](const Shape& part) {
                              return ComponentCutter(part, options).run(by);
                            }));
}

/// Returns the pieces of a part that is cut into its components, and each of these. Pieces too small for a
/// part, such as the cap of a foot, join the nearest one.
std::vector<std::int32_t> pieces_of(const Shape& part, SegmentationOptions options, CutsBy by) {
  const std::vector<std::int32_t> component = detail::merged_components(part);
  if (detail::is_rod_lattice(part, component)) return std::vector<std::int32_t>(component.size(), 0);
  options.method = SegmentationMethod::primitives;
  const detail::SurfaceGraph graph = detail::linked_surface_graph(part, options.min_part_area);
  return detail::merge_small_segments(graph, cut_components(part, component, options, by).triangle_part,
                                      options.min_part_area * graph.areas.sum());
}

/// Throws InputError where a part of a shape with several has no area.
void check_areas(const Shape& shape) {
  if (shape.part_count() < 2) return;
  std::vector<char> has_area(shape.part_names.size(), 0);
  for (std::size_t t = 0; t < shape.triangle_part.size(); ++t)
    if (detail::has_area(shape, static_cast<Eigen::Index>(t)))
      has_area[static_cast<std::size_t>(shape.triangle_part[t])] = 1;
  const auto without = std::find(has_area.begin(), has_area.end(), 0);
  if (without != has_area.end())
    throw InputError("part '" + shape.part_names[static_cast<std::size_t>(without - has_area.begin())] +
                     "' has no triangle of positive area");
}

/// Cuts the parts of several members. Member k of "leg" is called "leg.k".
Shape with_members(const Shape& shape, const SegmentationOptions& options,
                   const detail::SymmetrySource& symmetries, const detail::MemberRule& rule = {}) {
  const std::vector<Shape> parts = extract_parts(shape);
  std::vector<std::vector<std::int32_t>> members(parts.size());
  const double diagonal = bounding_diagonal(shape);
  const auto is_cut = [](const std::vector<std::int32_t>& of_part) { return count_of(of_part) > 1; };
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t p) {
    if (detail::is_small(parts[p], diagonal))
      members[p].assign(parts[p].triangle_part.size(), 0);
    else
      for (const CutsBy by : {CutsBy::concave_edges, CutsBy::fitting})
        if (members[p].empty() || !is_cut(members[p]))
          members[p] = detail::members(
              parts[p], [&](const Shape& part) { return pieces_of(part, options, by); }, rule);
  });
  if (std::none_of(members.begin(), members.end(), is_cut)) return shape;
  detail::make_symmetric(parts, symmetry_relations(shape, symmetries()), options.min_part_area, members);
  Shape result = shape;
  result.part_names.clear();
  std::vector<std::int32_t> first;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    first.push_back(static_cast<std::int32_t>(result.part_names.size()));
    const std::string& name = shape.part_names[p];
    const std::int32_t count = count_of(members[p]);
    for (std::int32_t k = 1; k <= count; ++k)
      result.part_names.push_back(count == 1 ? name : member_name(name, k));
  }
  std::vector<std::size_t> next(parts.size(), 0);
  for (std::int32_t& part : result.triangle_part) {
    const auto p = static_cast<std::size_t>(part);
    part = first[p] + members[p][next[p]++];
  }
  validate(result);
  return result;
}

/// Cuts the components of several members. Such a file may be one union but for a bar that stands apart.
Shape with_members_of_components(const Shape& components, const SegmentationOptions& options,
                                 const detail::SymmetrySource& symmetries) {
  detail::MemberRule rule;
  rule.max_members = detail::ConvexRegionRule().max_regions;
  const Shape members =
      with_members(detail::with_flat_triangles_at_their_edges(components), options, symmetries, rule);
  return with_parts_by_area(components, members.triangle_part);
}

/// Cuts a connected shape where its symmetries let it: what was cut on one side of a plane only, or cut
/// elsewhere, is cut alike on both.
Shape cut_symmetrically(const Shape& shape, const SegmentationOptions& options,
                        const detail::SymmetrySource& symmetries) {
  const std::vector<std::int32_t> one_component(shape.triangle_part.size(), 0);
  Shape result = cut_components(shape, one_component, options, CutsBy::concave_edges);
  if (result.part_count() == 1) return result;
  const Shape whole = with_parts_by_area(shape, one_component);
  std::vector<std::vector<std::int32_t>> pieces = {result.triangle_part};
  detail::make_symmetric({whole}, symmetry_relations(whole, symmetries()), options.min_part_area, pieces);
  return with_parts_by_area(shape, pieces.front());
}

}  // namespace

Shape segment(const Shape& shape, const SegmentationOptions& options) {
  return detail::segment(shape, options, [&] { return find_symmetries(shape); });
}

Shape detail::segment(const Shape& shape, const SegmentationOptions& options,
                      const SymmetrySource& symmetries) {
  check(options);
  validate(shape);
  const bool members = options.method == SegmentationMethod::members ||
                       (options.method == SegmentationMethod::automatic && shape.part_count() > 1);
  if (members || options.method == SegmentationMethod::given) check_areas(shape);
  if (options.method == SegmentationMethod::given) return shape;
  if (members) return with_members(detail::with_flat_triangles_at_their_edges(shape), options, symmetries);
  const std::vector<std::int32_t> one_part(shape.triangle_part.size(), 0);
  if (options.method == SegmentationMethod::whole) return with_parts_by_area(shape, one_part);
  const std::vector<std::int32_t> component = detail::merged_components(shape);
  if (options.method == SegmentationMethod::automatic && options.parts == 0 &&
      detail::is_rod_lattice(shape, component))
    return with_parts_by_area(shape, one_part);
  const bool components_do =
      options.method == SegmentationMethod::automatic &&
      (count_of(component) > 1 || (options.parts == 0 && is_body_of_revolution(shape)));
  if (options.method == SegmentationMethod::components || components_do) {
    Shape components = with_parts_by_area(shape, component);
    if (options.method == SegmentationMethod::components || options.parts > 0 || components.part_count() == 1)
      return components;
    return with_members_of_components(components, options, symmetries);
  }
  // A number of parts that is asked for is kept.
  if (count_of(component) == 1 && options.parts == 0) return cut_symmetrically(shape, options, symmetries);
  return cut_components(shape, component, options, CutsBy::concave_edges);
}

}  // namespace stackabilization
