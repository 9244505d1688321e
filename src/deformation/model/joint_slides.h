#pragma once

#include <Eigen/Core>
#include <array>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Sets Relation::slack of every joint, and Relation::carrier and Relation::sliding of every joint of which a
/// point can slide without a visible change: on a plate (a cuboid at most a third as thick as wide, or a flat
/// generalized cylinder) anywhere in its plane, on a member (a straight cuboid or generalized cylinder at
/// least 3 times as long as wide) along it, on the wall of a hollow box (Cuboid::inner_sides) in its plane,
/// on that of a straight vessel (GeneralizedCylinder::inner_radii; at least 1.5 times as deep as its mean
/// radius) up and down. Points at the rim of a plate, or within 15 % of half the length from the end of a
/// member or the border of a wall, stay there, as do those of parts that are flush with a side: a shelf that
/// is flush with the edge of a panel moves up and down the edge. The part carries the joint on which its
/// points slide along all ways rather than along an edge or not at all, else the one with the joint farther
/// from its rim or end.
void let_joints_yield(Structure& structure);

/// Returns the axes of a carrier that is a cuboid along which joints far from its rim slide; every one of
/// other carriers.
std::array<bool, 3> sliding_ways(const Primitive& carrier, const Eigen::Vector3d& point);

/// Returns how far a joint at `point` has slid beyond the rim or the end of its carrier along its ways
/// (Relation::sliding), model units; 0 if it is on the carrier.
double distance_beyond(const Primitive& carrier, const Eigen::Vector3d& point,
                       const std::array<bool, 3>& ways);

/// Returns the projector onto the directions in which a joint at `point` is held on a carrier along whose
/// axes it slides: the normal of a plate or of the nearest wall of a hollow box, the plane across a member,
/// across an edge, or across the side of a vessel, all directions for other primitives.
Eigen::Matrix3d held_directions(const Primitive& carrier, const Eigen::Vector3d& point,
                                const std::array<bool, 3>& ways);

}  // namespace stackabilization::detail
