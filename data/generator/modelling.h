#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

/// The few constructions that the shipped models are made of. Lengths in metres, z up, x to the right of a
/// person who sits on the object, y to the back. Every construction returns a closed, outward oriented shape
/// of one part.
namespace stackabilization::models {

/// A closed curve in space, counter-clockwise seen from where a loft goes.
using Ring = std::vector<Eigen::Vector3d>;
/// A polyline in the half plane (distance, height), or an outline in (x, y).
using Curve = std::vector<Eigen::Vector2d>;
/// Horizontal outline for a distance: a radius, or an offset from a nominal outline. Always the same point
/// count.
using Outline = std::function<Curve(double)>;
using Path = std::vector<Eigen::Vector3d>;

/// A corner of a profile, rounded by a parabola that begins and ends `reach` away from it.
struct Knot {
  double distance = 0, height = 0, reach = 0;
};
/// The polyline through the knots with rounded corners and no piece longer than `step`. A reach is cut to
/// 0.45 of the pieces that meet in the corner.
Curve profile(const std::vector<Knot>& knots, double step);

Outline circle(int segments);
/// Circles drawn out along y, for hats.
Outline ellipse(int segments, double y_factor);
struct Rectangle {
  double width = 1, depth = 1;     ///< Along x and y at offset 0.
  double radius = 0.1;             ///< Of the corners at offset 0; offsets inwards stay below it.
  int corner_points = 5;           ///< Per corner.
  int pieces_x = 1, pieces_y = 1;  ///< Pieces of the straight sides along x and y.
};
Outline rounded_rectangle(const Rectangle& rectangle);

/// Skin through the rings; both ends are closed by `cap_rings` shrunken copies around their centres.
Shape loft(const std::vector<Ring>& rings, int cap_rings = 1);
/// Profile from the underside to the upper side, swept around the outline: vessels, seats, discs.
Shape lathe(const Curve& profile, const Outline& outline, int cap_rings = 2);
/// Closed profile, counter-clockwise, that never reaches the axis: rims and bands.
Shape hoop(const Curve& profile, const Outline& outline);
/// Flat slab between two heights, all edges rounded by `edge`.
struct Slab {
  double bottom = 0, top = 0.02;
  double edge = 0.004;
  int cap_rings = 3;
};
Shape slab(const Slab& slab, const Outline& outline);

/// Cross-section of a bar: width along `side`, depth across both side and path.
struct Section {
  double width = 0.02, depth = 0.02;
};
/// A bar along a path: leg, handle, rail, plank.
struct Bar {
  Path path;                                        ///< Two points or more; centres of the sections.
  Eigen::Vector3d side = Eigen::Vector3d::UnitX();  ///< Never parallel to the path.
  Section first, last;                              ///< Blended along the arc length.
  double roundness = 0.4;                           ///< Corner radius over half the smaller side; 1 is round.
  double edge = 0.002;                              ///< Rounding of both ends.
  int corner_points = 3;
  double step = 0.08;  ///< Longest piece along the path.
};
Shape bar(const Bar& bar);
/// Round bar from a to b with the two diameters.
Shape rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector2d& diameters,
          int segments = 16);
/// Cut off flush with the floor, z = 0: vertices below it are lifted onto it.
Shape levelled(Shape shape);

/// Cubic Bezier curve with these four control points, cut into `pieces`.
Path bezier(const Eigen::Matrix<double, 4, 3>& control, int pieces);

/// Several pieces as one part.
Shape joined(const std::vector<Shape>& pieces);
/// Every vertex moved.
Shape moved(Shape shape, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& place);
Shape shifted(Shape shape, const Eigen::Vector3d& by);
/// Turned about z by an angle in degrees.
Shape turned(Shape shape, double degrees);

/// Collects the parts of a model.
class Assembly {
 public:
  void add(const std::string& name, Shape part);
  /// The part and its mirror image across x = 0 as NAME_right (x > 0, as given) and NAME_left.
  void add_pair(const std::string& name, const Shape& part);
  /// All parts, lowered to the floor z = 0, in metres, coordinates rounded to a micrometre.
  Shape finished() const;

 private:
  Shape shape_;
};

}  // namespace stackabilization::models
