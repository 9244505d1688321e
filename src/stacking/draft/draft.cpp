#include "stackabilization/stacking/draft.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "envelope/contacts/contact_polygons.h"
#include "envelope/contacts/planar_union.h"
#include "mesh/surface_moments.h"
#include "mesh/triangle_tree.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/closed_surface.h"
#include "stackabilization/stacking/tolerances.h"
#include "stacking/validation/solid_location.h"

namespace stackabilization {
namespace {

using namespace detail;

/// The triangles `rows` of a shape, each with corners of its own.
Shape extract_triangles(const Shape& shape, const std::vector<std::int32_t>& rows) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  Points corners(3 * count, 3);
  Triangles triangles(count, 3);
  for (Eigen::Index k = 0; k < 3 * count; ++k) {
    corners.row(k) = shape.corner(rows[static_cast<std::size_t>(k / 3)], static_cast<int>(k % 3));
    triangles(k / 3, k % 3) = static_cast<std::int32_t>(k);
  }
  return make_shape(std::move(corners), std::move(triangles));
}

/// Parts with closed surfaces: only these have an inside.
Shape closed_parts(const Shape& shape) {
  std::vector<std::vector<std::int32_t>> rows(shape.part_names.size());
  for (std::size_t t = 0; t < shape.triangle_part.size(); ++t)
    rows[static_cast<std::size_t>(shape.triangle_part[t])].push_back(static_cast<std::int32_t>(t));
  std::vector<std::int32_t> solid;
  for (const std::vector<std::int32_t>& part : rows)
    if (closed_surface(extract_triangles(shape, part)).closed)
      solid.insert(solid.end(), part.begin(), part.end());
  return solid.empty() ? Shape{} : extract_triangles(shape, solid);
}

/// Returns the portion of a convex polygon in space (k x 3) that lies over another one, seen along `along`.
Points common_part(const Points& polygon, const Points& other, const Eigen::Vector3d& along) {
  Points kept = polygon;
  const Eigen::RowVector3d centre = other.colwise().mean();
  for (Eigen::Index e = 0; e < other.rows() && kept.rows() > 0; ++e) {
    const Eigen::RowVector3d from = other.row(e), side = other.row((e + 1) % other.rows()) - from;
    Eigen::RowVector3d across = along.transpose().cross(side);
    if (across.dot(centre - from) < 0) across = -across;
    Points next(2 * kept.rows(), 3);
    Eigen::Index count = 0;
    for (Eigen::Index c = 0; c < kept.rows(); ++c) {
      const Eigen::RowVector3d a = kept.row(c), b = kept.row((c + 1) % kept.rows());
      const double at_a = across.dot(a - from), at_b = across.dot(b - from);
      if (at_a >= 0) next.row(count++) = a;
      if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0))
        next.row(count++) = a + at_a / (at_a - at_b) * (b - a);
    }
    kept = next.topRows(count);
  }
  return kept;
}

/// Bounds of the work on one triangle: triangles in the column of a wall, and pairs of pieces of which one is
/// hidden from above and the other from below.
constexpr std::size_t max_in_column = 1 << 13, max_pairs_of_pieces = 1 << 20;

/// Convex pieces of a triangle in the frame of the direction, and the frame in which their areas are seen.
class Pieces {
 public:
  Pieces(const Points& triangle, const Eigen::Vector3d& along)
      : frame_(frame_of(Direction(along))), whole_(outline_area(outline_of(triangle, frame_))) {}

  /// Returns the portion of the triangle under the union of pieces.
  double share(const std::vector<Points>& pieces) const {
    std::vector<ConvexPolygon> outlines;
    for (const Points& piece : pieces) outlines.push_back(outline_of(piece, frame_));
    return whole_ > 0 ? std::min(1.0, union_area(outlines) / whole_) : 0;
  }
  Eigen::Vector3d centre(const Points& piece) const {
    return piece.transpose() * outline_centroid(outline_of(piece, frame_));
  }
  bool cover_all(const std::vector<Points>& pieces) const {
    return !pieces.empty() && share(pieces) >= 1 - tolerance::relative;
  }
  /// Returns the intersection of the unions. Where there are too many pairs of pieces it returns nothing, and
  /// `complete` becomes false.
  std::vector<Points> common(std::vector<Points> some, std::vector<Points> others, bool& complete) const {
    if (some.empty() || others.empty()) return {};
    if (cover_all(some)) return others;
    if (cover_all(others)) return some;
    if (some.size() > max_pairs_of_pieces / others.size()) {
      complete = false;
      return {};
    }
    std::vector<Points> both;
    for (const Points& one : some)
      for (const Points& other : others)
        if (Points part = common_part(one, other, frame_.w); part.rows() > 2) both.push_back(std::move(part));
    return both;
  }

 private:
  Frame frame_;
  double whole_;
};

/// Portions of a triangle below, and above, other triangles.
struct Hidden {
  std::vector<Points> from_above, from_below;
};

/// What is known of one triangle.
struct Examined {
  TriangleDraft draft;
  std::vector<Points> undercut;  ///< in the frame of the direction
  bool complete = true;          ///< see DraftAnalysis
};

/// Everything is in the frame of the direction, which is +z there.
class DraftPass {
 public:
  /// `copies`: triangles with the same points as others.
  DraftPass(Shape shape, const std::vector<TriangleCopy>& copies)
      : shape_(std::move(shape)),
        height_(range_along(shape_, Eigen::Vector3d::UnitZ())),
        tree_(shape_, distinct_triangles(shape_, copies)),
        solid_(closed_parts(shape_)),
        locator_(solid_) {}

  /// `hidden`: what contact polygons know of the triangle, which is nothing for walls.
  Examined examine(std::int32_t t, Hidden hidden) const {
    Examined result;
    TriangleDraft& draft = result.draft;
    const Eigen::Vector3d vector = area_vector(shape_, t), normal = vector.stableNormalized();
    const double across = vector.head<2>().norm();
    draft.area = vector.norm();
    if (normal.isZero()) return result;
    const bool wall = std::abs(vector.z()) <= tolerance::wall_slope * across;
    if (!wall) draft.angle = std::atan2(std::abs(vector.z()), across) * 180 / std::numbers::pi;
    const Pieces pieces(triangle_points(t), wall ? normal : Eigen::Vector3d(0, 0, 1));
    std::vector<Points> inner;
    for (Points& piece :
         wall ? hidden_beside(t, pieces, result.complete)
              : pieces.common(std::move(hidden.from_above), std::move(hidden.from_below), result.complete))
      (is_inner(pieces.centre(piece), normal) ? inner : result.undercut).push_back(std::move(piece));
    draft.undercut_area = pieces.share(result.undercut) * draft.area;
    draft.inner_area = std::min(pieces.share(inner) * draft.area, draft.area - draft.undercut_area);
    return result;
  }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

  static std::vector<std::int32_t> distinct_triangles(const Shape& shape,
                                                      const std::vector<TriangleCopy>& copies) {
    std::vector<char> repeated(static_cast<std::size_t>(shape.triangle_count()));
    for (const TriangleCopy& copy : copies) repeated[static_cast<std::size_t>(copy.copy)] = 1;
    std::vector<std::int32_t> rows;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(shape.triangle_count()); ++t)
      if (!repeated[static_cast<std::size_t>(t)] && has_area(shape, t)) rows.push_back(t);
    return rows;
  }
  Points triangle_points(std::int32_t t) const {
    Points corners(3, 3);
    for (int c = 0; c < 3; ++c) corners.row(c) = shape_.corner(t, c);
    return corners;
  }

  /// Returns what of a wall is hidden on both of its sides, of which one may be solid.
  std::vector<Points> hidden_beside(std::int32_t wall, const Pieces& pieces, bool& complete) const {
    std::vector<Points> ahead = hidden_beside(wall, pieces, 1, complete);
    if (ahead.empty()) return ahead;
    return pieces.common(std::move(ahead), hidden_beside(wall, pieces, -1, complete), complete);
  }

  /// Returns what of a wall is hidden from above and from below on its side `side`: 1 ahead of the normal, -1
  /// behind it.
  std::vector<Points> hidden_beside(std::int32_t wall, const Pieces& pieces, double side,
                                    bool& complete) const {
    const Points corners = triangle_points(wall);
    const double low = corners.col(2).minCoeff(), high = corners.col(2).maxCoeff(), own = high - low;
    // Most hidden walls are inside a solid, whose triangles are near.
    const Hidden near = shadows(wall, side, {low - own, high + own}, complete);
    if (pieces.cover_all(near.from_above) && pieces.cover_all(near.from_below)) return {corners};
    Hidden all = shadows(wall, side, height_, complete);
    return pieces.common(std::move(all.from_above), std::move(all.from_below), complete);
  }

  /// Returns what triangles between two heights hide of a wall on one side.
  Hidden shadows(std::int32_t wall, double side, const Range& heights, bool& complete) const {
    const Points corners = triangle_points(wall);
    const Eigen::Vector3d normal = unit_normal(shape_, wall);
    const double reach = tolerance::beside_surface * height_.length();
    const Eigen::RowVector3d low = corners.colwise().minCoeff().array() - 2 * reach,
                             high = corners.colwise().maxCoeff().array() + 2 * reach;
    std::vector<std::size_t> met;
    tree_.append_met(CGAL::Bbox_3(low.x(), low.y(), heights.low, high.x(), high.y(), heights.high), met);
    if (met.size() > max_in_column) {
      complete = false;
      return {};
    }
    std::sort(met.begin(), met.end());
    Hidden hidden;
    for (const std::size_t entry : met) {
      const auto section = section_of(tree_.rows()[entry], normal, normal.dot(corners.row(0)) + side * reach);
      if (!section) continue;
      for (const bool above : {true, false})
        if (Points part = common_part(corners, shadow_of(*section, above), normal); part.rows() > 2)
          (above ? hidden.from_above : hidden.from_below).push_back(std::move(part));
    }
    return hidden;
  }

  /// Returns the segment in which triangle `t` meets the plane normal . p = offset.
  std::optional<std::array<Eigen::Vector3d, 2>> section_of(std::int32_t t, const Eigen::Vector3d& normal,
                                                           double offset) const {
    std::array<Eigen::Vector3d, 2> ends;
    std::size_t count = 0;
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d a = shape_.corner(t, c), b = shape_.corner(t, (c + 1) % 3);
      const double at_a = normal.dot(a) - offset, at_b = normal.dot(b) - offset;
      if ((at_a < 0) != (at_b < 0) && count < 2) ends[count++] = a + at_a / (at_a - at_b) * (b - a);
    }
    if (count < 2) return std::nullopt;
    return ends;
  }

  /// Returns what of the upright plane through a segment lies below it (`above`: the segment hides it from
  /// above), or above it.
  Points shadow_of(const std::array<Eigen::Vector3d, 2>& segment, bool above) const {
    const double end = above ? height_.low - height_.length() : height_.high + height_.length();
    Points shadow(4, 3);
    shadow.row(0) = segment[0];
    shadow.row(1) = segment[1];
    shadow.row(2) << segment[1].x(), segment[1].y(), end;
    shadow.row(3) << segment[0].x(), segment[0].y(), end;
    return shadow;
  }

  bool is_inner(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d step = tolerance::beside_surface * height_.length() * normal;
    for (const Eigen::Vector3d& p : {Eigen::Vector3d(point + step), Eigen::Vector3d(point - step)})
      if (locator_.locate({p.x(), p.y(), p.z()}).place == PointPlace::outside) return false;
    return true;
  }

  Shape shape_;
  Range height_;
  TriangleTree<Kernel> tree_;
  Shape solid_;
  SolidLocator locator_;
};

}  // namespace

DraftAnalysis analyse_draft(const Shape& shape, const SeparationTree& tree, const Direction& direction) {
  constexpr std::int64_t pairs_per_triangle = 16, more_pairs = std::int64_t{1} << 16;
  const Frame frame = frame_of(direction);
  Eigen::Matrix3d to_local, to_world;
  to_local << frame.u.transpose(), frame.v.transpose(), frame.w.transpose();
  to_world << frame.u, frame.v, frame.w;
  const double resolution = tolerance::relative * range_along(shape, frame.w).length() / direction.length();
  const ContactPolygons found =
      contact_polygons(tree.data(), direction,
                       {ContactSemantics::solid, resolution,
                        more_pairs + pairs_per_triangle * shape.triangle_count(), resolution});
  const auto count = static_cast<std::size_t>(shape.triangle_count());
  std::vector<Hidden> hidden(count);
  for (const ContactPolygon& polygon : found.polygons) {
    hidden[static_cast<std::size_t>(polygon.upper_triangle)].from_below.push_back(polygon.upper_points *
                                                                                  to_world);
    hidden[static_cast<std::size_t>(polygon.lower_triangle)].from_above.push_back(polygon.lower_points *
                                                                                  to_world);
  }
  const DraftPass pass(transformed(shape, to_local, Eigen::Vector3d::Zero()), tree.data().copies);
  std::vector<Examined> examined(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
    examined[t] = pass.examine(static_cast<std::int32_t>(t), std::move(hidden[t]));
  });
  DraftAnalysis result;
  result.complete = found.complete;
  for (std::size_t t = 0; t < count; ++t) {
    result.complete = result.complete && examined[t].complete;
    result.triangles.push_back(examined[t].draft);
    for (const Points& piece : examined[t].undercut)
      result.undercuts.push_back({static_cast<std::int32_t>(t), piece * to_local});
  }
  return result;
}

}  // namespace stackabilization
