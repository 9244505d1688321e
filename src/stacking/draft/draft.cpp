#include "stackabilization/stacking/draft.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "core/bounding_diagonal.h"
#include "envelope/contacts/contact_polygons.h"
#include "mesh/surface_moments.h"
#include "mesh/triangle_tree.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/tolerances.h"
#include "stacking/draft/pieces.h"
#include "stacking/draft/solid_sides.h"
#include "stacking/draft/wall_sections.h"

namespace stackabilization {
namespace {

using namespace detail;

/// Limit of the triangles above and below a wall.
constexpr std::size_t max_in_column = 1 << 13;

/// Portions of a triangle that others hide: from above and from below; of a wall, ahead of its normal and
/// behind it.
struct Hidden {
  std::vector<Piece> one_way, other_way;
};

/// What is known of one triangle.
struct Examined {
  TriangleDraft draft;
  std::vector<Piece> undercut;  ///< in the frame of the direction
  bool complete = true;         ///< see DraftAnalysis
};

/// Everything is in the frame of the direction, which is +z there.
class DraftPass {
 public:
  /// `first`: per triangle, the first one with the same points.
  DraftPass(Shape shape, const std::vector<std::size_t>& first)
      : shape_(std::move(shape)),
        height_(range_along(shape_, Eigen::Vector3d::UnitZ())),
        reach_(tolerance::beside_surface * bounding_diagonal(shape_)),
        tree_(shape_, distinct_triangles(shape_, first)),
        sides_(shape_, reach_) {}

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
    const Pieces pieces(corners_of(t), wall ? normal : Eigen::Vector3d(0, 0, 1));
    if (wall) hidden = hidden_beside(t, pieces, result.complete);
    std::vector<Piece> all = pieces.common(hidden.one_way, hidden.other_way, result.complete);
    const double share = pieces.share(all);
    // What lies inside is hidden both ways. Pieces overlap: a large one may contain what a smaller one, of
    // either way, knows to be inside.
    std::vector<Piece> inner;
    if (share > 0) {
      const auto is_inside = [&](const Piece& piece) { return sides_.both(piece, normal); };
      for (std::vector<Piece>* list : {&hidden.one_way, &hidden.other_way, &all})
        pieces.move_those(*list, inner, is_inside);
      result.undercut = std::move(all);
    }
    const double inner_share = std::min(share, pieces.share(inner));
    draft.inner_area = inner_share * draft.area;
    draft.undercut_area = (share - inner_share) * draft.area;
    return result;
  }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

  static std::vector<std::int32_t> distinct_triangles(const Shape& shape,
                                                      const std::vector<std::size_t>& first) {
    std::vector<std::int32_t> rows;
    for (std::size_t t = 0; t < first.size(); ++t)
      if (const auto row = static_cast<std::int32_t>(t); first[t] == t && has_area(shape, row))
        rows.push_back(row);
    return rows;
  }

  Piece corners_of(std::int32_t t) const {
    return {shape_.corner(t, 0), shape_.corner(t, 1), shape_.corner(t, 2)};
  }

  /// Returns what of a wall is hidden on each of its sides, of which one may be solid: nothing where one of
  /// them is free.
  Hidden hidden_beside(std::int32_t wall, const Pieces& pieces, bool& complete) const {
    std::vector<Piece> ahead = hidden_beside(wall, pieces, 1, complete);
    if (ahead.empty()) return {};
    return {std::move(ahead), hidden_beside(wall, pieces, -1, complete)};
  }

  /// Returns what of a wall lies between triangles above and below on its side `side`: 1 ahead of the normal,
  /// -1 behind it.
  std::vector<Piece> hidden_beside(std::int32_t wall, const Pieces& pieces, double side,
                                   bool& complete) const {
    Range own{shape_.corner(wall, 0).z(), shape_.corner(wall, 0).z()};
    for (int c = 1; c < 3; ++c)
      own = {std::min(own.low, shape_.corner(wall, c).z()), std::max(own.high, shape_.corner(wall, c).z())};
    // Most hidden walls are inside a solid, whose triangles are near.
    std::vector<Piece> near =
        between_sections(wall, side, {own.low - own.length(), own.high + own.length()}, complete);
    if (pieces.cover_all(near)) return near;
    return between_sections(wall, side, height_, complete);
  }

  /// Returns what of a wall lies between the highest and the lowest of the triangles beside it that are
  /// within a range of heights.
  std::vector<Piece> between_sections(std::int32_t wall, double side, const Range& heights,
                                      bool& complete) const {
    const Piece corners = corners_of(wall);
    const Eigen::Vector3d normal = unit_normal(shape_, wall);
    const Eigen::Vector3d along = Eigen::Vector3d(-normal.y(), normal.x(), 0).normalized();
    const double offset = normal.dot(corners[0]);
    const std::vector<std::size_t> met = column_of(corners, heights);
    if (met.size() > max_in_column) {
      complete = false;
      return {};
    }
    std::vector<PlaneSection> sections;
    for (const std::size_t entry : met)
      if (const auto ends = section_of(tree_.rows()[entry], normal, offset + side * reach_))
        sections.push_back(plane_section(along, (*ends)[0], (*ends)[1]));
    std::vector<Piece> found;
    const auto point = [&](double s, double height) {
      return Eigen::Vector3d(offset * normal + s * along + height * Eigen::Vector3d::UnitZ());
    };
    for (const Trapezoid& area : area_between(std::move(sections))) {
      const Piece quad{point(area.from, area.low_from), point(area.to, area.low_to),
                       point(area.to, area.high_to), point(area.from, area.high_from)};
      if (Piece part = common_part(corners, quad, normal); part.size() > 2) found.push_back(std::move(part));
    }
    return found;
  }

  /// Returns the triangles above and below a triangle within a range of heights, entries of the tree's rows.
  std::vector<std::size_t> column_of(const Piece& corners, const Range& heights) const {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& corner : corners) box.extend(corner);
    const double margin = 2 * reach_;
    std::vector<std::size_t> met;
    tree_.append_met(CGAL::Bbox_3(box.min().x() - margin, box.min().y() - margin, heights.low,
                                  box.max().x() + margin, box.max().y() + margin, heights.high),
                     met);
    return met;
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

  Shape shape_;
  Range height_;
  double reach_;  ///< distance at which one looks beside a wall, model units
  TriangleTree<Kernel> tree_;
  SolidSides sides_;
};

/// Returns, per triangle, the first one with the same points.
std::vector<std::size_t> first_triangles(const SeparationTree& tree, std::size_t count) {
  std::vector<std::size_t> first(count);
  std::iota(first.begin(), first.end(), 0);
  for (const TriangleCopy& copy : tree.data().copies)
    first[static_cast<std::size_t>(copy.copy)] = static_cast<std::size_t>(copy.first);
  return first;
}

/// Returns the points in another frame.
Piece turned(const Points& points, const Eigen::Matrix3d& turn) {
  Piece piece;
  for (Eigen::Index k = 0; k < points.rows(); ++k) piece.emplace_back(turn * points.row(k).transpose());
  return piece;
}

/// Returns the piece as rows, in another frame.
Points turned(const Piece& piece, const Eigen::Matrix3d& turn) {
  Points points(static_cast<Eigen::Index>(piece.size()), 3);
  for (std::size_t k = 0; k < piece.size(); ++k)
    points.row(static_cast<Eigen::Index>(k)) = (turn * piece[k]).transpose();
  return points;
}

}  // namespace

DraftAnalysis analyse_draft(const Shape& shape, const SeparationTree& tree, const Direction& direction) {
  constexpr std::int64_t pairs_per_triangle = 16, more_pairs = std::int64_t{1} << 16;
  const Frame frame = frame_of(direction);
  Eigen::Matrix3d to_world;
  to_world << frame.u, frame.v, frame.w;
  const Eigen::Matrix3d to_local = to_world.transpose();
  // Of the diagonal, for a shape without extent along r has no triangle above another one either.
  const double apart = tolerance::relative * bounding_diagonal(shape) / direction.length();
  const ContactPolygons found = contact_polygons(
      tree.data(), direction,
      {ContactSemantics::solid, apart, more_pairs + pairs_per_triangle * shape.triangle_count(), apart});
  const auto count = static_cast<std::size_t>(shape.triangle_count());
  const std::vector<std::size_t> first = first_triangles(tree, count);
  std::vector<Hidden> hidden(count);
  for (const ContactPolygon& polygon : found.polygons) {
    const auto upper = static_cast<std::size_t>(polygon.upper_triangle);
    const auto lower = static_cast<std::size_t>(polygon.lower_triangle);
    if (first[upper] != upper || first[lower] != lower) continue;
    hidden[upper].other_way.push_back(turned(polygon.upper_points, to_local));
    hidden[lower].one_way.push_back(turned(polygon.lower_points, to_local));
  }
  const DraftPass pass(transformed(shape, to_local, Eigen::Vector3d::Zero()), first);
  std::vector<Examined> examined(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
    if (first[t] == t) examined[t] = pass.examine(static_cast<std::int32_t>(t), std::move(hidden[t]));
  });
  DraftAnalysis result;
  result.complete = found.complete;
  for (std::size_t t = 0; t < count; ++t) {
    const Examined& known = examined[first[t]];
    result.complete = result.complete && known.complete;
    result.triangles.push_back(known.draft);
    for (const Piece& piece : known.undercut)
      result.undercuts.push_back({static_cast<std::int32_t>(t), turned(piece, to_world)});
  }
  return result;
}

}  // namespace stackabilization
