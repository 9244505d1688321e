#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "stackabilization/structure/structure.h"

/// Shapes with the structure that their makers know, for the tests.
namespace stackabilization::structures {

/// Straight, `sections` of them at equal distances from `a` to `b`.
GeneralizedCylinder straight_cylinder(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius,
                                      int sections);
/// `sections` of them on the arc from angle `from` to `to` (radians) around the origin in the x, z plane.
GeneralizedCylinder arc_cylinder(double arc_radius, double radius, double from, double to, int sections);
/// Closed, in the plane z = 0 around the origin.
GeneralizedCylinder ring_cylinder(double ring_radius, double radius, int sections);

/// The primitive of a part, which has to be of that kind.
Cuboid cuboid(const std::vector<Primitive>& primitives, int part = 0);
GeneralizedCylinder cylinder(const std::vector<Primitive>& primitives, int part = 0);

/// Row of the part of this name, which has to be there.
int part_named(const StructuredShape& structured, const std::string& name);

/// Box part of a shape and its structure.
StructuredShape box_alone(const Eigen::Vector3d& size);
/// One generalized cylinder whose mesh is a tube of circles around its sections; `around` points each.
StructuredShape tube_alone(const GeneralizedCylinder& cylinder, int around);

/// Table around the z axis, 8 x 8 x 6: parts "top", "leg_1" to "leg_4", "bar_1" to "bar_4" between the legs.
/// Mirror planes x = 0 and y = 0 (pairs of legs, pairs of bars, the rest symmetric to themselves). A point
/// joint of each leg with the top, and of each bar with its two legs. Triangles are subdivided `levels`
/// times.
StructuredShape table(int levels = 0);
/// The table with line joints between bars and legs.
StructuredShape table_with_line_joints();

/// Box "board", 10 x 10 x 1, and on the middle of its top, z = 0.5, a cube "screw" of 0.1 with a point joint.
StructuredShape board_with_screw();

/// Stool around the z axis, 10 x 10 x 16: box "top" and "leg_1" to "leg_4", straight generalized cylinders
/// with point joints. Mirror planes x = 0 and y = 0, which the mesh does not have: leg k has 11 + k sides.
StructuredShape rough_stool();

/// A top, 10 x 10 x 1, on one leg, 0.8 x 0.8 x 10, in its middle, and an apron beside the leg, under the top.
/// The joint of leg and apron, (0.4, 0, 9.5), is 0.5 below that of leg and top. The apron is joined to the
/// top at its rim, at (4.9, 0, 10).
StructuredShape leg_and_apron();

/// Trestle in the plane y = 0, 10 high: straight generalized cylinders "leg_left" and "leg_right" that lean
/// towards each other, from x = -4 and 4 to -2 and 2, and "rung" between them at z = 4, with point joints on
/// the axes of the legs. Mirror plane x = 0. With `shelf`, a box "shelf" between the legs from z = 5.5 to 6.
StructuredShape trestle(bool shelf = false);

/// Boxes "slat_1" to "slat_5" along x, 20 x 1.2 x 0.5, side by side at steps of 2 along y around the z axis,
/// on "rail_1" and "rail_2" along y at x = -8 and 8. Mirror planes x = 0 and y = 0, but where `skewed`: only
/// x = 0. A point joint of every slat with both rails.
StructuredShape slats_on_rails(bool skewed = false);

/// Ladder in the plane y = 0, 16 high: straight generalized cylinders "leg_left" and "leg_right" from x = -5
/// and 5 to -3 and 3, and "rung_1" to "rung_7" between their axes at z = 2, 4, ..., 14, with point joints
/// there. Mirror plane x = 0.
StructuredShape ladder();

/// Mug around the z axis: "body", a straight generalized cylinder, and "handle", a curved one in the plane y
/// = 0, with two point joints; mirror plane y = 0.
StructuredShape mug(int around = 24);
/// A ring handle on a post: closed generalized cylinder, one joint.
StructuredShape post_with_ring();

}  // namespace stackabilization::structures
