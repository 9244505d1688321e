#pragma once

#include "stackabilization/core/shape.h"

/// Models of any size, for experiments about costs. Lengths are plain numbers without a unit; z is up.
namespace stackabilization::experiments {

/// A cup 90 high that widens from radius 30 to 40, walls 2 thick, with 12 waves around and 5 up the wall: one
/// closed part of about `triangles` triangles.
Shape wavy_cup(int triangles);

/// Two upright posts with `count` - 2 bars between them: closed boxes that touch, each a part of its own.
/// Precondition: `count` is at least 2.
Shape rack(int count);

/// Cubes of side 1, each a part of its own, in rows, columns and layers without gaps: `count` of the smallest
/// cube of cubes that holds so many, lowest layers first.
Shape cube_grid(int count);

/// Cubes of side 1, each a part of its own, all in the same place.
Shape coincident_cubes(int count);

}  // namespace stackabilization::experiments
