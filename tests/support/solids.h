#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

/// Analytic solids for the tests. Every solid is closed, outward oriented and of one part unless its line
/// says otherwise; z is up. A function NAME_f_max gives f_max of NAME in closed form, `solid` semantics
/// unless it says otherwise, in units of the direction vector; without a direction it is for (0, 0, 1).
namespace stackabilization::solids {

using Polygon = std::vector<Eigen::Vector2d>;

struct NamedShape {
  std::string name;
  Shape shape;
};

/// Point k of n on the unit circle, from angle 0 counter-clockwise. Quarter turns are exact, so for n
/// divisible by four the extremes are exactly +-1 and opposite points are exact negatives.
Eigen::Vector2d circle_point(int k, int n);
Polygon regular_polygon(int n);  ///< n points of the unit circle.

/// Triangles of a simple polygon given counter-clockwise (ear clipping), as rows of the polygon.
Triangles triangulate(const Polygon& polygon);

/// [lowest, highest], lowest < highest in each coordinate.
Shape box(const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest);
inline Shape box(const Eigen::Vector3d& size) {
  return box(Eigen::Vector3d::Zero(), size);
}
/// The box without half of its bottom and half of its top.
Shape open_box(const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest);
inline Shape open_box(const Eigen::Vector3d& size) {
  return open_box(Eigen::Vector3d::Zero(), size);
}
/// A convex body slides free after its longest chord along r: min over axes of size / |r|.
double box_f_max(const Eigen::Vector3d& size, const Direction& direction);

/// Boxes [0,1]x[0,1]x[0,1] ("low") and [1,2]x[0,1]x[2,3] ("high"): their walls lie in the plane x = 1, three
/// units from bottom to top. Along z nothing but a column of zero width holds both, so `solid` f_max is 1,
/// `closed` is 3.
Shape boxes_sharing_wall();

/// Counter-clockwise polygon in (x, y), convex or not, swept over z in [0, height]. f_max along z is the
/// height.
Shape prism(const Polygon& polygon, double height);
/// Counter-clockwise polygon in (x, z) swept over y in [0, width].
Shape extruded_profile(const Polygon& polygon, double width);

/// Corners in any order; the shape is outward oriented.
Shape tetrahedron(const std::array<Eigen::Vector3d, 4>& corners);
/// Let r have barycentric coordinates b (sum 0). A chord t r of the tetrahedron is a difference of two points
/// with barycentric coordinates in [0, 1] that sum to 1, so t times the sum of the positive b is at most 1,
/// and 1 is reached.
double tetrahedron_f_max(const std::array<Eigen::Vector3d, 4>& corners, const Direction& direction);

/// Solid of a closed profile polygon in (rho, z), rho >= 0, counter-clockwise, swept around z over a regular
/// n-gon: the ring at rho is the n-gon of circumradius rho. Rings are homothetic, so u and l depend on rho
/// alone and closed forms found in the profile hold exactly for the polyhedron too.
Shape surface_of_revolution(const Polygon& profile, int segments);

/// Regular n-gon of circumradius `radius` swept over [0, height]. f_max along z is the height; along x, for
/// even n, the diameter; along (x, 0, z), for even n, min(diameter / |x|, height / |z|), as for a box.
Shape cylinder(double radius, double height, int segments);

/// A cup without handle: between an outer and an inner cone frustum. Inner radii are smaller than outer ones.
struct FrustumShell {
  double outer_bottom = 3, outer_top = 4;      ///< Circumradii at z = 0 and z = height; bottom <= top.
  double inner_bottom = 2.5, inner_top = 3.5;  ///< Circumradii at z = floor and z = height; bottom <= top.
  double height = 8;
  double floor = 0.5;
  int segments = 64;
};
Shape frustum_shell(const FrustumShell& cup);
/// f is piecewise linear in rho, with a knee where the foot ends (rho = outer_bottom: u is the inner wall, l
/// = 0) and where the inner wall reaches the rim (rho = inner_top: u = height, l is the outer wall); the
/// larger value wins.
double frustum_shell_f_max(const FrustumShell& cup);

/// `count` steps of `tread` x `rise`, solid down to the ground, `width` along y. Both f_max along z (last
/// step, count * rise) and along x (first step, count * tread) span the whole solid.
struct Stairs {
  int count = 4;
  double tread = 1, rise = 0.75, width = 2;
  double thickness = 0.25;  ///< Of the plate of `stair_plate`, horizontal and vertical; below tread and rise.
};
Shape stairs(const Stairs& options);
/// Stairs folded from a plate: every tread and riser is `thickness` thick. Two steps at least.
Shape stair_plate(const Stairs& options);
/// Over a riser u - l = (i + 1) rise - (i rise - thickness): rise + thickness. Over a tread it is the
/// thickness.
double stair_plate_f_max(const Stairs& options);

/// Standing L in (x, z): arms [0, thickness] x [0, size] and [0, size] x [0, thickness], width 1 along y.
Shape l_shape(double size, double thickness);
/// Along z and x the size. Along (1, 0, 1) copies nest: the chord from the inner side of the standing arm is
/// `thickness` long in units of r, and so is the one through the corner.
double l_shape_f_max(double size, double thickness, const Direction& direction);

/// Upright U in (x, z), size x size with arms and bottom `thickness` thick. f_max is the size along x and
/// along z.
Shape u_shape(double size, double thickness);

/// Three parts that touch in faces: two bars, one right above the other, joined by a ramp beside them. Extent
/// `length` along x, 2 along y, `height` along z.
struct Hook {
  double length = 4, height = 6, thickness = 1;  ///< height > 3 thickness.
};
/// f_max along z is the height, for the upper bar lies over the lower one. But a copy lifted by any
/// t in [thickness, height - 2 thickness] is clear of the hook: there the lower bar hangs between the two
/// bars.
Shape hook(const Hook& options);

/// A glass whose foot is wider than its mouth but narrower than its belly. f_max along z is the height, 13:
/// the rim stands over the foot. Yet a copy lifted by 9 is clear of it, its foot caught inside the belly.
Shape wine_glass(int segments);

/// Rings of `ring_segments` and tube polygons of `tube_segments` points, both divisible by four. f_max along
/// z is twice the tube radius, along x twice the sum of both radii, exactly.
struct Torus {
  double ring_radius = 3, tube_radius = 1;
  int ring_segments = 32, tube_segments = 16;
};
Shape torus(const Torus& options);

/// Icosahedron around the origin with corners on the sphere, every triangle cut in four `levels` times. From
/// level 1 on the poles of all axes are corners, so f_max along them is the diameter; at every level so along
/// any diameter between corners.
Shape sphere(double radius, int levels);

/// An open sheet without thickness, z = 0.6 (x^2 + y^2) + 0.02 sin 40x cos 37y over [-1, 1]^2, each of the
/// cells x cells squares cut in two. Over any line along (0.3, -0.2, 1) or z it has one point at most, so
/// that f_max is 0 and every triangle touches its copy and its neighbours.
Shape bumpy_bowl(int cells);

/// Parts "top", "leg_1" .. "leg_4": square top of `width`, vertical square legs flush with its corners. f_max
/// along z is the whole height.
struct Table {
  double width = 8, height = 6, top = 0.5, leg = 1;
};
Shape table(const Table& options);

/// A storage bin after the published Gridfinity profile, in millimetres, 1 x 1 cell, with straight mitred
/// corners. Foot, from below: 0.8 at 45 degrees, 1.8 upright, 2.15 at 45 degrees (4.75 high) up to the
/// outline of 41.5, which leaves 0.5 of the grid of 42. Lip: 0.7 at 45 degrees, 1.8 upright, 1.9 at 45
/// degrees (4.4 high) up to the same outline. The lip begins at 7 mm times `units`.
struct GridfinityBin {
  int units = 3;      ///< Height units of 7 mm; two at least.
  double seat = 1.5;  ///< Width of the flat ledge inside the foot of the lip; 0 leaves it out.
};
Shape gridfinity_bin(const GridfinityBin& options);
/// With the seat (wider than the play of 0.35) the flat foot of the next bin, at z = 0, rests on it at z = 7
/// units: both are whole numbers, so f_max is exactly 7 units in doubles, 21 for three. The sloped faces
/// would meet 0.35 lower (foot 17.8 + z, lip 18.15 + z: 0.25 of play at the outline and 0.1 for the deeper
/// foot), which is f_max without a seat, up to rounding.
double gridfinity_bin_f_max(const GridfinityBin& options);

}  // namespace stackabilization::solids
