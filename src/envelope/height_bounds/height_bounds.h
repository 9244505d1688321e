#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/edge_table.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A rectangle along the axes of a projection, low <= high.
struct PlanarBox {
  double x_low, x_high, y_low, y_high;

  double width() const { return x_high - x_low; }
  double height() const { return y_high - y_low; }
  /// Returns whether the other rectangle is within this one, borders included.
  bool contains(const PlanarBox& other) const {
    return x_low <= other.x_low && other.x_high <= x_high && y_low <= other.y_low && other.y_high <= y_high;
  }
  bool meets(const PlanarBox& other) const {
    return x_low <= other.x_high && other.x_low <= x_high && y_low <= other.y_high && other.y_low <= y_high;
  }
  /// Returns the quarters, those with low y first, of these the one with low x.
  std::array<PlanarBox, 4> quarters() const {
    const double x = x_low / 2 + x_high / 2, y = y_low / 2 + y_high / 2;
    return {PlanarBox{x_low, x, y_low, y}, PlanarBox{x, x_high, y_low, y}, PlanarBox{x_low, x, y, y_high},
            PlanarBox{x, x_high, y, y_high}};
  }
  /// Returns the largest distance of its points from the origin.
  double radius() const {
    return std::hypot(std::max(std::abs(x_low), std::abs(x_high)),
                      std::max(std::abs(y_low), std::abs(y_high)));
  }
};

/// Bounds of an envelope over a rectangle.
struct HeightBound {
  /// -inf unless every point of the rectangle is certainly under the surface.
  double low = -std::numeric_limits<double>::infinity();
  /// -inf if certainly no point is.
  double high = -std::numeric_limits<double>::infinity();
  /// Of the envelope at the points that are under the surface, but for points, with an area below rounding,
  /// that only triangles seen edge-on cover; inf if certainly none is.
  double covered_low = std::numeric_limits<double>::infinity();

  bool certainly_covered() const { return low > -std::numeric_limits<double>::infinity(); }
  bool possibly_covered() const { return high > -std::numeric_limits<double>::infinity(); }
};

/// A mesh seen along a direction: points are rows (x, y, height).
struct ProjectedMesh {
  Points points;               ///< rows (x, y, height), heights exact
  const Triangles* triangles;  ///< rows of `points`
  const EdgeTable* edges;      ///< of `triangles`
  double error = 0;            ///< bound on |computed - exact| of x and y
};

/// Certified bounds of the upper envelope of a mesh over rectangles, from a quadtree that is refined where it
/// is asked for.
///
/// The lower bound rests on a fact about patches. A patch is a set of triangles connected through edges that
/// have as many triangles on one side as on the other, seen along the direction. All triangles counted
/// counter-clockwise, how often a patch covers a point changes only across its border, the other edges. So a
/// rectangle that meets a triangle of a patch and no edge of its border is covered everywhere, and the lowest
/// point of the patch over it is a lower bound. Triangles seen edge-on belong to no patch.
///
/// At the border of a closed component, one whose edges all run as often forwards as backwards, what covers a
/// point once from below covers it once from above too. So the higher one of the lowest points of both sides
/// is a lower bound there.
///
/// Bounds hold for the exact coordinates: tests of overlap and heights of planes allow for `error` and for
/// rounding. Not for several threads at a time.
class HeightBounds {
 public:
  explicit HeightBounds(ProjectedMesh mesh);

  /// Returns the box of the projection.
  const PlanarBox& box() const { return nodes_.front().box; }
  /// Returns bounds of u(p) - slope . p over the points p of a rectangle, where u is the envelope. With the
  /// slope of the surface they are narrow for large rectangles too.
  HeightBound over(const PlanarBox& rectangle, const Eigen::Vector2d& slope = Eigen::Vector2d::Zero());
  /// Returns bounds of the area of the projection, from so many rectangles.
  Range covered_area(int rectangles);
  /// Returns the slope of the face that is highest over a point, as far as rounding can tell; zero where
  /// there is none, or where many faces are near.
  Eigen::Vector2d slope_at(double x, double y) const;

 private:
  /// A side of the closed components that a triangle belongs to, or none.
  enum class Side { from_above, from_below, open };
  /// A triangle with the gradient of its plane; zero gradient and an infinite error where it is too steep.
  struct Face {
    std::array<double, 3> x, y;  ///< counter-clockwise
    double h_low, h_high;
    double base_height, slope_x, slope_y, plane_error;
    double thickness;    ///< bound of twice the area, for triangles seen edge-on; 0 for others
    std::int32_t patch;  ///< -1: seen edge-on
    Side side;           ///< unless it is seen edge-on
  };
  struct Border {
    std::array<double, 2> x, y;
    std::int32_t patch;
  };
  struct Node {
    PlanarBox box;
    std::vector<std::int32_t> faces, borders;
    std::int32_t first_child = -1;
    std::int32_t depth = 0;
    bool known = false;
    HeightBound bound;
  };
  enum class Overlap { none, possible, certain };

  void make_faces(const ProjectedMesh& mesh);
  void make_patches(const ProjectedMesh& mesh);
  void open_components(const ProjectedMesh& mesh);
  HeightBound over(std::int32_t node, const PlanarBox& rectangle, const Eigen::Vector2d& slope);
  HeightBound sheared(const HeightBound& bound, const PlanarBox& box, const Eigen::Vector2d& slope) const;
  HeightBound whole(std::int32_t node, int levels);
  HeightBound direct(const Node& node, const PlanarBox& rectangle, const Eigen::Vector2d& slope);
  void split(std::int32_t node);
  Overlap overlap(const Face& face, const PlanarBox& rectangle) const;
  bool meets(const Border& border, const PlanarBox& rectangle) const;
  HeightBound plane_bound(const Face& face, const PlanarBox& rectangle, const Eigen::Vector2d& slope) const;

  std::vector<Face> faces_;
  std::vector<Border> borders_;
  std::vector<Node> nodes_;
  double error_ = 0;        ///< of coordinates
  double size_ = 0;         ///< largest coordinate
  double cross_error_ = 0;  ///< of a side of an edge, per unit of its length
  /// Per patch, for one call of `direct`: its lowest height, and what is known of it.
  struct PatchState {
    std::int64_t call = 0;
    double low = 0;
    bool touched = false, bordered = false;
  };
  std::vector<PatchState> patches_;
  std::int64_t call_ = 0;
};

}  // namespace stackabilization::detail
