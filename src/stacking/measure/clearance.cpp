#include "stackabilization/stacking/clearance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include "core/index.h"
#include "mesh/edge_table.h"
#include "mesh/planar.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

/// Returns the triangles with welded vertices (the first vertex of equal coordinates), so that neighbours are
/// found in files with repeated vertices.
Triangles welded_triangles(const Shape& shape) {
  const detail::WeldedMesh mesh = detail::weld(shape);
  return mesh.triangles.unaryExpr([&](std::int32_t point) { return mesh.first_vertex[detail::at(point)]; });
}

/// The polygon P, counter-clockwise in the frame's u, v coordinates.
class Polygon {
 public:
  Polygon(double play, int corners) {
    const double step = 2 * std::numbers::pi / corners;
    for (int i = 0; i < corners; ++i) {
      const double angle = (i + 0.5) * step, radius = play / std::cos(step / 2);
      corners_.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  }

  std::size_t size() const { return corners_.size(); }
  const Eigen::Vector2d& corner(std::size_t i) const { return corners_[i % size()]; }
  Eigen::Vector2d edge(std::size_t i) const { return corner(i + 1) - corner(i); }

 private:
  std::vector<Eigen::Vector2d> corners_;
};

/// Collects the pieces of M + P that touch the lower envelope of the sum; of the upper one when heights are
/// negated.
///
/// Over q the lower envelope is the least height of M over the polygon q - P. Where a triangle attains it, it
/// does so at one of its vertices inside q - P, where one of its edges enters q - P, or at the corner of q -
/// P that lies farthest downhill. A piece is left out when a neighbouring triangle clearly leads further down
/// inside q - P.
class Dilation {
 public:
  Dilation(const Shape& shape, const Direction& direction, const DilationOptions& options)
      : shape_(shape),
        frame_(frame_of(direction)),
        polygon_(options.play, options.corners),
        plan_(shape.vertex_count(), 2),
        height_(shape.vertex_count()),
        welded_(welded_triangles(shape)),
        edges_(welded_, detail::EdgeTable::Collapsed::keep) {
    plan_.col(0) = shape.vertices * frame_.u;
    plan_.col(1) = shape.vertices * frame_.v;
    height_ = shape.vertices * frame_.w;
  }

  void collect_lower() { collect(); }
  void collect_upper() {
    height_ = -height_;
    collect();
    height_ = -height_;
  }

  DilatedShape result() const {
    if (corners_.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
      throw UsageError("the dilated shape would have more vertices than can be indexed");
    DilatedShape dilated;
    dilated.source_triangle = sources_;
    Shape& shape = dilated.shape;
    shape.part_names = shape_.part_names;
    shape.unit = shape_.unit;
    shape.vertices.resize(static_cast<Eigen::Index>(corners_.size()), 3);
    for (std::size_t v = 0; v < corners_.size(); ++v)
      shape.vertices.row(static_cast<Eigen::Index>(v)) = corners_[v].transpose();
    shape.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      shape.triangles.row(static_cast<Eigen::Index>(t)) = triangles_[t];
      shape.triangle_part.push_back(shape_.triangle_part[static_cast<std::size_t>(sources_[t])]);
    }
    return dilated;
  }

 private:
  std::int32_t vertex(std::int32_t triangle, int corner) const { return welded_(triangle, corner); }
  Eigen::Vector3d point(std::int32_t v) const { return shape_.vertices.row(v).transpose(); }
  Eigen::Vector2d plan(std::int32_t from, std::int32_t to) const {
    return (plan_.row(to) - plan_.row(from)).transpose();
  }
  double rise(std::int32_t from, std::int32_t to) const { return height_[to] - height_[from]; }
  double distance(std::int32_t from, std::int32_t to) const { return (point(to) - point(from)).norm(); }
  Eigen::Vector3d shifted(std::int32_t v, const Eigen::Vector2d& shift) const {
    return point(v) + frame_.u * shift.x() + frame_.v * shift.y();
  }

  void collect() {
    for (std::int32_t t = 0; t < shape_.triangle_count(); ++t) collect_triangle(t);
    for (std::size_t e = 0; e < edges_.size(); ++e) collect_edge(edges_[e]);
    collect_vertices();
  }

  /// Translates by the corner of P that is farthest uphill, and by all corners that rounding does not
  /// distinguish from it.
  void collect_triangle(std::int32_t t) {
    const std::int32_t a = vertex(t, 0), b = vertex(t, 1), c = vertex(t, 2);
    const Eigen::Vector2d d = plan(a, b), w = plan(a, c);
    const double area = cross(d, w);
    if (area == 0) return;
    const double size = distance(a, b) * distance(a, c);
    const Eigen::Vector2d uphill =
        Eigen::Vector2d(rise(a, b) * w.y() - rise(a, c) * d.y(), rise(a, c) * d.x() - rise(a, b) * w.x()) *
        (area > 0 ? 1 : -1);
    const bool sideless = std::abs(area) <= tolerance::relative * size;
    double most = 0;
    for (std::size_t i = 0; i < polygon_.size(); ++i) most = std::max(most, uphill.dot(polygon_.corner(i)));
    const double slack = tolerance::relative * size * polygon_.corner(0).norm();
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
      const double along = uphill.dot(polygon_.corner(i));
      if (along < most - slack && !(sideless && -along >= most - slack)) continue;
      const Eigen::Vector2d& shift = polygon_.corner(i);
      add({shifted(a, shift), shifted(b, shift), shifted(c, shift)}, t);
    }
  }

  /// Sweeps one edge along every edge of P over which it can attain the lower envelope.
  void collect_edge(std::span<const detail::TriangleSide> sides) {
    const std::int32_t a = sides.front().low, b = sides.front().high;
    const Eigen::Vector2d d = plan(a, b);
    const double up = rise(a, b), length = distance(a, b);
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
      const Eigen::Vector2d sweep = polygon_.edge(i);
      const double outward = cross(d, sweep);
      if (outward == 0) continue;
      // The upward direction of the edge must point into q - P; otherwise the edge is lower elsewhere.
      if (up * outward < -tolerance::relative * length * length * sweep.norm()) continue;
      const bool lowest = std::none_of(sides.begin(), sides.end(), [&](const detail::TriangleSide& side) {
        return descends(side, sweep);
      });
      if (!lowest) continue;
      const Eigen::Vector2d &from = polygon_.corner(i), &to = polygon_.corner(i + 1);
      add({shifted(a, from), shifted(b, from), shifted(b, to), shifted(a, to)}, sides.front().triangle);
    }
  }

  /// Returns whether the triangle clearly descends from its edge along `sweep` or its opposite.
  bool descends(const detail::TriangleSide& side, const Eigen::Vector2d& sweep) const {
    const std::int32_t opposite = vertex(side.triangle, (side.corner + 2) % 3);
    const Eigen::Vector2d d = plan(side.low, side.high), w = plan(side.low, opposite);
    const double up_d = rise(side.low, side.high), up_w = rise(side.low, opposite);
    const double across = cross(d, sweep);
    const double slope = (cross(sweep, w) * up_d + across * up_w) * (across > 0 ? 1 : -1);
    const double size =
        distance(side.low, opposite) * std::abs(up_d) + distance(side.low, side.high) * std::abs(up_w);
    return slope < -tolerance::relative * sweep.norm() * size;
  }

  /// Adds P at every vertex from which no edge clearly descends.
  void collect_vertices() {
    std::vector<std::int32_t> triangle_at(static_cast<std::size_t>(shape_.vertex_count()), -1);
    std::vector<char> lowest(triangle_at.size(), 1);
    for (const detail::TriangleSide& side : edges_.sides()) {
      const double up = rise(side.low, side.high);
      const double slack = tolerance::relative * distance(side.low, side.high);
      for (const std::int32_t v : {side.low, side.high})
        if (triangle_at[static_cast<std::size_t>(v)] < 0)
          triangle_at[static_cast<std::size_t>(v)] = side.triangle;
      if (up < -slack) lowest[static_cast<std::size_t>(side.low)] = 0;
      if (up > slack) lowest[static_cast<std::size_t>(side.high)] = 0;
    }
    for (std::size_t v = 0; v < lowest.size(); ++v) {
      if (triangle_at[v] < 0 || !lowest[v]) continue;
      std::vector<Eigen::Vector3d> outline;
      for (std::size_t i = 0; i < polygon_.size(); ++i)
        outline.push_back(shifted(static_cast<std::int32_t>(v), polygon_.corner(i)));
      add(outline, triangle_at[v]);
    }
  }

  /// A convex planar outline as a fan of triangles.
  void add(const std::vector<Eigen::Vector3d>& outline, std::int32_t source) {
    const auto first = static_cast<std::int32_t>(corners_.size());
    corners_.insert(corners_.end(), outline.begin(), outline.end());
    for (std::int32_t i = 2; i < static_cast<std::int32_t>(outline.size()); ++i) {
      triangles_.emplace_back(first, first + i - 1, first + i);
      sources_.push_back(source);
    }
  }

  const Shape& shape_;
  Frame frame_;
  Polygon polygon_;
  Eigen::Matrix<double, Eigen::Dynamic, 2> plan_;
  Eigen::VectorXd height_;
  Triangles welded_;
  detail::EdgeTable edges_;
  std::vector<Eigen::Vector3d> corners_;
  std::vector<Eigen::RowVector3i> triangles_;
  std::vector<std::int32_t> sources_;
};

}  // namespace

DilatedShape dilate_laterally(const Shape& shape, const Direction& direction,
                              const DilationOptions& options) {
  if (!std::isfinite(options.play) || options.play < 0)
    throw UsageError("the lateral play must be a finite length of at least 0");
  if (options.corners < 4 || options.corners > 256 || options.corners % 2 != 0)
    throw UsageError("the polygon of lateral shifts needs an even number of corners from 4 to 256");
  validate(shape);
  if (options.play == 0) {
    DilatedShape unchanged{shape,
                           std::vector<std::int32_t>(static_cast<std::size_t>(shape.triangle_count()))};
    std::iota(unchanged.source_triangle.begin(), unchanged.source_triangle.end(), 0);
    return unchanged;
  }
  Dilation dilation(shape, direction, options);
  if (options.side != DilatedSide::upper) dilation.collect_lower();
  if (options.side != DilatedSide::lower) dilation.collect_upper();
  return dilation.result();
}

Separation separation_with_play(const Shape& below, const Shape& above, const Direction& direction,
                                const PlayOptions& options) {
  // Shifting one copy by s or the other by -s is the same, and P is symmetric about its centre.
  const DilatedShape dilated =
      dilate_laterally(below, direction, {options.play, options.corners, DilatedSide::upper});
  if (dilated.shape.triangle_count() == 0) return {};
  Separation result = separation(SeparationTree(dilated.shape), SeparationTree(above), direction,
                                 {.semantics = options.semantics, .abandon_above = std::nullopt});
  if (result.blocked)
    result.witness.upper_triangle =
        dilated.source_triangle[static_cast<std::size_t>(result.witness.upper_triangle)];
  return result;
}

}  // namespace stackabilization
