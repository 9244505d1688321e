#pragma once

#include <vector>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/rendering/scene.h"
#include "stackabilization/structure/structure.h"

/// What pictures of structures and of edits share. Private to rendering/.
namespace stackabilization::detail {

/// Parts that the symmetry relations take onto each other, directly or by way of others: one list per orbit,
/// each in the order of the parts, larger orbits first; a part without a counterpart is alone.
std::vector<std::vector<int>> symmetry_orbits(const Structure& structure);

/// One colour per part: orbits of several parts have hues that are far apart, lone parts quieter ones. None
/// is the green or the red of the joints.
std::vector<Colour> part_colours(const Structure& structure);

/// Sphere of about 200 triangles.
Shape ball(const Eigen::Vector3d& centre, double radius);

/// Round bar between two points; a ball where they are one point.
Shape bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

/// The edges of a cuboid; the circles of a generalized cylinder, threaded on its curve.
std::vector<Points> outline(const Primitive& primitive);

/// Circle of section `section`, a closed polyline.
Points section_circle(const GeneralizedCylinder& cylinder, Eigen::Index section);

/// The quadrangles of a cuboid as a surface; no triangles for a generalized cylinder.
Shape faces(const Primitive& primitive);

/// Border of the part of the plane through `point` with normal `normal` that lies in the axis-parallel box, a
/// closed polyline; empty when they do not meet.
Points plane_in_box(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const OrientedBox& box);

}  // namespace stackabilization::detail
