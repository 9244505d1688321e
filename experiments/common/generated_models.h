#pragma once

#include "stackabilization/core/shape.h"

/// Models of any size, for experiments about costs. Lengths are plain numbers without a unit; z is up.
namespace stackabilization::experiments {

/// A cup 90 high that widens from radius 30 to 40, walls 2 thick, with 12 waves around and 5 up the wall: one
/// closed part of about `triangles` triangles.
Shape wavy_cup(int triangles);

/// An open bowl without thickness, z = 0.6 (x^2 + y^2) + 0.02 sin 40x cos 37y over [-1, 1]^2, of about
/// `triangles` triangles. It is nowhere over itself along z and (0.3, -0.2, 1): f_max is 0, and every
/// triangle touches its copy and its neighbours.
Shape bumpy_bowl(int triangles);

/// An upright oval tube without thickness, open at both ends, of about `triangles` triangles: walls that
/// slide along z over their whole length.
Shape oval_tube(int triangles);

/// Two upright posts with `count` - 2 bars between them: closed boxes that touch, each a part of its own.
/// Precondition: `count` is at least 2.
Shape rack(int count);

/// Cubes of side 1, each a part of its own, in rows, columns and layers without gaps: `count` of the smallest
/// cube of cubes that holds so many, lowest layers first.
Shape cube_grid(int count);

/// Cubes of side 1, each a part of its own, all in the same place.
Shape coincident_cubes(int count);

}  // namespace stackabilization::experiments
