#pragma once

#include <vector>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/rendering/scene.h"
#include "stackabilization/structure/structure.h"

/// Colours and shapes of structures in pictures.
namespace stackabilization::detail {

/// Returns the orbits of parts under the symmetry relations, one list per orbit. Parts are in order, larger
/// orbits come first. A part without a counterpart is an orbit of its own.
std::vector<std::vector<int>> symmetry_orbits(const Structure& structure);

/// Returns one colour per part. Orbits of several parts have distant hues, single parts have less saturated
/// colours. No colour is the green or the red of the joints.
std::vector<Colour> part_colours(const Structure& structure);

/// Returns a sphere of about 200 triangles.
Shape ball(const Eigen::Vector3d& centre, double radius);

/// Returns a round bar between two points, or a ball when the points coincide.
Shape bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

/// Returns the edges of a cuboid, or the circles of a generalized cylinder with its curve.
std::vector<Points> outline(const Primitive& primitive);

/// Returns the circle of section `section` as a closed polyline.
Points section_circle(const GeneralizedCylinder& cylinder, Eigen::Index section);

/// Returns the faces of a cuboid as a surface; no triangles for a generalized cylinder.
Shape faces(const Primitive& primitive);

/// Returns the border of the intersection of a box and the plane through `point` with normal `normal`, as a
/// closed polyline; empty when they do not intersect. Precondition: the box is axis-parallel.
Points plane_in_box(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const OrientedBox& box);

}  // namespace stackabilization::detail
