#include "stackabilization/stacking/draft.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "envelope/contacts/contact_polygons.h"
#include "envelope/contacts/planar_union.h"
#include "mesh/planar.h"
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
struct ClosedParts {
  Shape shape;
  std::vector<Eigen::AlignedBox3d> boxes;  ///< of their connected components
};

ClosedParts closed_parts(const Shape& shape) {
  std::vector<std::vector<std::int32_t>> rows(shape.part_names.size());
  for (std::size_t t = 0; t < shape.triangle_part.size(); ++t)
    rows[static_cast<std::size_t>(shape.triangle_part[t])].push_back(static_cast<std::int32_t>(t));
  ClosedParts closed;
  std::vector<std::int32_t> all;
  for (const std::vector<std::int32_t>& part : rows) {
    const ClosedSurface surface = closed_surface(extract_triangles(shape, part));
    if (!surface.closed) continue;
    const std::size_t first = closed.boxes.size();
    closed.boxes.resize(first + surface.representatives.size());
    for (std::size_t k = 0; k < part.size(); ++k)
      if (const std::int32_t component = surface.component[k]; component >= 0)
        for (int c = 0; c < 3; ++c)
          closed.boxes[first + static_cast<std::size_t>(component)].extend(shape.corner(part[k], c));
    all.insert(all.end(), part.begin(), part.end());
  }
  if (!all.empty()) closed.shape = extract_triangles(shape, all);
  return closed;
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
constexpr std::size_t max_in_column = 1 << 13, max_pairs_of_pieces = 1 << 16;

/// Returns whether all corners of a convex polygon lie in another one.
bool contains(const ConvexPolygon& outer, const ConvexPolygon& inner) {
  double twice = 0;
  for (std::size_t p = 2; p < outer.size(); ++p) twice += cross(outer[p - 1] - outer[0], outer[p] - outer[0]);
  const double sign = twice < 0 ? -1 : 1;
  for (std::size_t p = 0; p < outer.size(); ++p) {
    const Eigen::Vector2d &a = outer[p], side = outer[(p + 1) % outer.size()] - a;
    for (const Eigen::Vector2d& corner : inner)
      if (sign * cross(side, corner - a) < 0) return false;
  }
  return twice != 0;
}

/// Pieces that are united first.
constexpr std::size_t few = 8;

/// Convex pieces of a triangle in the frame of the direction, and the frame in which their areas are seen.
class Pieces {
 public:
  Pieces(const Points& triangle, const Eigen::Vector3d& along)
      : frame_(frame_of(Direction(along))), whole_(outline_area(outline_of(triangle, frame_))) {}

  /// Returns the portion of the triangle under the union of pieces.
  double share(const std::vector<Points>& pieces) const {
    if (!(whole_ > 0)) return 0;
    std::vector<std::pair<double, ConvexPolygon>> outlines;
    for (const Points& piece : pieces) {
      ConvexPolygon outline = outline_of(piece, frame_);
      const double area = outline_area(outline);
      outlines.emplace_back(area, std::move(outline));
    }
    std::stable_sort(outlines.begin(), outlines.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    // A union of many takes long; the largest few often cover all.
    std::vector<ConvexPolygon> largest;
    double share = 0;
    for (std::size_t k = 0; k < outlines.size(); ++k) {
      const auto first_few = largest.begin() + static_cast<std::ptrdiff_t>(std::min(few, largest.size()));
      const bool known = std::any_of(largest.begin(), first_few, [&](const ConvexPolygon& larger) {
        return contains(larger, outlines[k].second);
      });
      if (known && k + 1 < outlines.size()) continue;
      largest.push_back(std::move(outlines[k].second));
      const bool last = k + 1 == outlines.size();
      if (!last && (largest.size() % few != 0 || !std::has_single_bit(largest.size() / few))) continue;
      share = std::min(1.0, union_area(largest) / whole_);
      if (share >= 1 - tolerance::relative) return 1;
    }
    return share;
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

/// A segment in an upright plane: from left to right, with its heights there.
struct Section {
  double from, to, height_from, height_to;

  double at(double s) const { return height_from + (s - from) / (to - from) * (height_to - height_from); }
};

Section section(const Eigen::Vector3d& along, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double s = along.dot(a), t = along.dot(b);
  return s < t ? Section{s, t, a.z(), b.z()} : Section{t, s, b.z(), a.z()};
}

/// The area between two heights at `from` and two at `to`.
struct Trapezoid {
  double from, to, low_from, low_to, high_from, high_to;
};

/// Returns where the envelope of sections over [from, to], each of which covers it, has its corners: the
/// upper one for `sign` 1, the lower one for -1.
std::vector<double> envelope_corners(const std::vector<Section>& sections, double from, double to,
                                     double sign) {
  std::vector<double> corners{from};
  const auto rise = [&](const Section& one) {
    return sign * (one.height_to - one.height_from) / (one.to - one.from);
  };
  double s = from;
  const Section* top = nullptr;
  for (const Section& one : sections)
    if (!top || std::pair(sign * one.at(s), rise(one)) > std::pair(sign * top->at(s), rise(*top))) top = &one;
  while (top) {
    const Section* next = nullptr;
    double where = to;
    for (const Section& one : sections) {
      if (!(rise(one) > rise(*top))) continue;
      const double crossing = s + sign * (top->at(s) - one.at(s)) / (rise(one) - rise(*top));
      if (crossing < where || (next && crossing == where && rise(one) > rise(*next))) {
        where = std::max(s, crossing);
        next = &one;
      }
    }
    if (next) corners.push_back(s = where);
    top = next;
  }
  corners.push_back(to);
  return corners;
}

/// Returns the area between the lower and the upper envelope of sections.
std::vector<Trapezoid> between(std::vector<Section> sections) {
  std::erase_if(sections, [](const Section& one) { return !(one.from < one.to); });
  std::sort(sections.begin(), sections.end(), [](const Section& a, const Section& b) {
    return std::tie(a.from, a.to, a.height_from, a.height_to) <
           std::tie(b.from, b.to, b.height_from, b.height_to);
  });
  std::vector<double> ends;
  for (const Section& one : sections) ends.insert(ends.end(), {one.from, one.to});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Trapezoid> found;
  std::vector<Section> open;
  std::size_t next = 0;
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const double from = ends[k - 1], to = ends[k];
    std::erase_if(open, [from](const Section& one) { return one.to <= from; });
    for (; next < sections.size() && sections[next].from <= from; ++next) open.push_back(sections[next]);
    if (open.size() < 2) continue;
    std::vector<double> corners = envelope_corners(open, from, to, 1);
    const std::vector<double> lower = envelope_corners(open, from, to, -1);
    corners.insert(corners.end(), lower.begin(), lower.end());
    std::sort(corners.begin(), corners.end());
    const auto range = [&open](double s) {
      Range heights{open.front().at(s), open.front().at(s)};
      for (const Section& one : open)
        heights = {std::min(heights.low, one.at(s)), std::max(heights.high, one.at(s))};
      return heights;
    };
    for (std::size_t c = 1; c < corners.size(); ++c)
      if (corners[c - 1] < corners[c]) {
        const Range left = range(corners[c - 1]), right = range(corners[c]);
        found.push_back({corners[c - 1], corners[c], left.low, right.low, left.high, right.high});
      }
  }
  return found;
}

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
        locator_(solid_.shape) {}

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

  /// Returns what of a wall lies between triangles above and below on its side `side`: 1 ahead of the normal,
  /// -1 behind it.
  std::vector<Points> hidden_beside(std::int32_t wall, const Pieces& pieces, double side,
                                    bool& complete) const {
    const Points corners = triangle_points(wall);
    const double low = corners.col(2).minCoeff(), high = corners.col(2).maxCoeff(), own = high - low;
    // Most hidden walls are inside a solid, whose triangles are near.
    std::vector<Points> near = between_sections(wall, side, {low - own, high + own}, complete);
    if (pieces.cover_all(near)) return near;
    return between_sections(wall, side, height_, complete);
  }

  /// Returns what of a wall lies between the highest and the lowest of the triangles beside it that are
  /// within a range of heights.
  std::vector<Points> between_sections(std::int32_t wall, double side, const Range& heights,
                                       bool& complete) const {
    const Points corners = triangle_points(wall);
    const Eigen::Vector3d normal = unit_normal(shape_, wall);
    const Eigen::Vector3d along = Eigen::Vector3d(-normal.y(), normal.x(), 0).normalized();
    const double reach = tolerance::beside_surface * height_.length();
    const Eigen::RowVector3d low = corners.colwise().minCoeff().array() - 2 * reach,
                             high = corners.colwise().maxCoeff().array() + 2 * reach;
    std::vector<std::size_t> met;
    tree_.append_met(CGAL::Bbox_3(low.x(), low.y(), heights.low, high.x(), high.y(), heights.high), met);
    if (met.size() > max_in_column) {
      complete = false;
      return {};
    }
    const double offset = normal.dot(corners.row(0));
    std::vector<Section> sections;
    for (const std::size_t entry : met)
      if (const auto ends = section_of(tree_.rows()[entry], normal, offset + side * reach))
        sections.push_back(section(along, (*ends)[0], (*ends)[1]));
    std::vector<Points> found;
    for (const Trapezoid& area : between(std::move(sections))) {
      Points quad(4, 3);
      const auto corner = [&](Eigen::Index k, double s, double height) {
        quad.row(k) = offset * normal + s * along + height * Eigen::Vector3d::UnitZ();
      };
      corner(0, area.from, area.low_from);
      corner(1, area.to, area.low_to);
      corner(2, area.to, area.high_to);
      corner(3, area.from, area.high_from);
      if (Points part = common_part(corners, quad, normal); part.rows() > 2) found.push_back(std::move(part));
    }
    return found;
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

  /// Returns whether there is solid on both sides of a surface: that of two components.
  bool is_inner(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d step = tolerance::beside_surface * height_.length() * normal;
    int around = 0;
    for (std::size_t k = 0; k < solid_.boxes.size() && around < 2; ++k)
      around += solid_.boxes[k].exteriorDistance(point) <= step.norm();
    if (around < 2) return false;
    for (const Eigen::Vector3d& p : {Eigen::Vector3d(point + step), Eigen::Vector3d(point - step)})
      if (locator_.locate({p.x(), p.y(), p.z()}).place == PointPlace::outside) return false;
    return true;
  }

  Shape shape_;
  Range height_;
  TriangleTree<Kernel> tree_;
  ClosedParts solid_;
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
  std::vector<std::size_t> first(count);  // of the triangles with the same points
  std::iota(first.begin(), first.end(), 0);
  for (const TriangleCopy& copy : tree.data().copies)
    first[static_cast<std::size_t>(copy.copy)] = static_cast<std::size_t>(copy.first);
  std::vector<Hidden> hidden(count);
  for (const ContactPolygon& polygon : found.polygons) {
    const auto upper = static_cast<std::size_t>(polygon.upper_triangle);
    const auto lower = static_cast<std::size_t>(polygon.lower_triangle);
    if (first[upper] != upper || first[lower] != lower) continue;
    hidden[upper].from_below.push_back(polygon.upper_points * to_world);
    hidden[lower].from_above.push_back(polygon.lower_points * to_world);
  }
  const DraftPass pass(transformed(shape, to_local, Eigen::Vector3d::Zero()), tree.data().copies);
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
    for (const Points& piece : known.undercut)
      result.undercuts.push_back({static_cast<std::int32_t>(t), piece * to_local});
  }
  return result;
}

}  // namespace stackabilization
