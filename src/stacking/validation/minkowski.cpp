#include "stackabilization/stacking/minkowski.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/convex_decomposition_3.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/minkowski_sum_3.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/closed_surface.h"
#include "stacking/measure/exact_number.h"

namespace stackabilization {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Number = Kernel::FT;
using Mesh = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

/// Triangles of one connected component with their own points.
struct Component {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> triangles;
};

std::vector<Component> components_of(const Shape& shape, const ClosedSurface& surface) {
  std::vector<Component> components(surface.representatives.size());
  std::vector<std::map<std::array<double, 3>, std::size_t>> known(components.size());
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const auto c = static_cast<std::size_t>(surface.component[static_cast<std::size_t>(t)]);
    std::vector<std::size_t> corners;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = shape.corner(t, k);
      const auto [entry, added] = known[c].try_emplace({p.x(), p.y(), p.z()}, components[c].points.size());
      if (added) components[c].points.emplace_back(p.x(), p.y(), p.z());
      corners.push_back(entry->second);
    }
    components[c].triangles.push_back(std::move(corners));
  }
  return components;
}

Nef solid_of(const Component& component) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  if (!pmp::is_polygon_soup_a_polygon_mesh(component.triangles))
    throw InputError(
        "the Minkowski sum needs closed 2-manifolds, but the solid touches itself at an edge or a vertex");
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(component.points, component.triangles, mesh);
  if (pmp::does_self_intersect(mesh))
    throw InputError("the Minkowski sum needs solids without self-intersections");
  const Nef solid(mesh);
  const bool inside_out = solid.volumes_begin()->mark();
  return inside_out ? solid.complement().closure() : solid;
}

/// Closed convex pieces whose union is the solid, as sets of corners.
std::vector<std::vector<Point>> convex_pieces(Nef solid) {
  CGAL::convex_decomposition_3(solid);
  std::vector<std::vector<Point>> pieces;
  for (auto volume = ++solid.volumes_begin(); volume != solid.volumes_end(); ++volume) {
    if (!volume->mark()) continue;
    Mesh piece;
    solid.convert_inner_shell_to_polyhedron(volume->shells_begin(), piece);
    pieces.emplace_back(piece.points_begin(), piece.points_end());
  }
  return pieces;
}

Nef hull_of(const std::vector<Point>& points) {
  Mesh hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  return Nef(hull);
}

std::vector<Point> mirrored(const std::vector<Point>& points) {
  std::vector<Point> result;
  for (const Point& p : points) result.push_back(CGAL::ORIGIN - (p - CGAL::ORIGIN));
  return result;
}

void check_areas(const Shape& shape) {
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    std::array<Point, 3> p;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d corner = shape.corner(t, k);
      p[static_cast<std::size_t>(k)] = {corner.x(), corner.y(), corner.z()};
    }
    if (CGAL::collinear(p[0], p[1], p[2]))
      throw InputError("triangle " + std::to_string(t) +
                       " has no area, so the Minkowski sum cannot be built");
  }
}

/// The largest t with t r in the closure of the points of an open set on the segment from 0 to `end`.
Number farthest_along(const Nef& set, const Kernel::Vector_3& r, const Point& end) {
  const std::vector<Point> segment = {CGAL::ORIGIN, end};
  using Range = std::pair<std::vector<Point>::const_iterator, std::vector<Point>::const_iterator>;
  const std::vector<Range> polylines = {{segment.begin(), segment.end()}};
  const Nef line(polylines.begin(), polylines.end(), Nef::Polylines_tag());
  const Nef inside = set.intersection(line);
  Number farthest = 0;
  for (auto edge = inside.halfedges_begin(); edge != inside.halfedges_end(); ++edge) {
    if (!edge->mark()) continue;
    const Number t = (edge->source()->point() - CGAL::ORIGIN) * r / r.squared_length();
    if (t > farthest) farthest = t;
  }
  return farthest;
}

/// A convex piece with its mirror image and its extent along r.
struct Piece {
  Nef set, mirror;
  Number low, high;
};

std::vector<Piece> pieces_along(const Nef& solid, const Kernel::Vector_3& r) {
  std::vector<Piece> pieces;
  for (const std::vector<Point>& corners : convex_pieces(solid)) {
    std::vector<Number> along;
    for (const Point& p : corners) along.push_back(r * (p - CGAL::ORIGIN));
    const auto [low, high] = std::minmax_element(along.begin(), along.end());
    pieces.push_back({hull_of(corners), hull_of(mirrored(corners)), *low, *high});
  }
  return pieces;
}

/// f_max in units of r: the farthest point on the line along r in the sum of any two open convex pieces.
/// Pairs that reach farthest come first, so that most of the others need no sum.
Number farthest_in_sum(const Shape& shape, const ClosedSurface& surface, const Direction& direction) {
  const Eigen::Vector3d& d = direction.vector();
  const Kernel::Vector_3 r(d.x(), d.y(), d.z());
  Nef solid;
  for (const Component& component : components_of(shape, surface)) solid = solid.join(solid_of(component));
  std::vector<Piece> pieces = pieces_along(solid, r);

  struct Pair {
    Number reach;
    std::size_t upper, lower;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t j = 0; j < pieces.size(); ++j)
      pairs.push_back({(pieces[i].high - pieces[j].low) / r.squared_length(), i, j});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.reach > b.reach; });

  Number farthest = 0;
  for (const Pair& pair : pairs) {
    if (pair.reach <= farthest) break;
    const Nef differences =
        CGAL::minkowski_sum_3(pieces[pair.upper].set, pieces[pair.lower].mirror).interior();
    farthest = std::max(farthest, farthest_along(differences, r, CGAL::ORIGIN + r * (pair.reach + 1)));
  }
  return farthest;
}

}  // namespace

Rational minkowski_translation(const Shape& solid, const Direction& direction) {
  validate(solid);
  if (solid.triangle_count() > max_minkowski_triangles)
    throw UsageError("a Minkowski sum of " + std::to_string(solid.triangle_count()) +
                     " triangles would take too long; the limit is " +
                     std::to_string(max_minkowski_triangles));
  const ClosedSurface surface = closed_surface(solid);
  if (!surface.closed) throw InputError("the Minkowski sum needs a closed, consistently oriented solid");
  check_areas(solid);
  try {
    return from_exact(CGAL::exact(farthest_in_sum(solid, surface, direction)));
  } catch (const CGAL::Failure_exception&) {
    throw InputError("the Minkowski sum of this solid cannot be built from convex pieces");
  }
}

}  // namespace stackabilization
