#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "structure/segmentation/surface_graph.h"

/// Not installed.
namespace stackabilization::detail {

/// A line through a shape at a point of its surface: how much is solid behind the point, and how closed in it
/// is.
struct Chord {
  std::int32_t triangle;
  double area;                ///< of the surface it stands for
  Eigen::Vector3d start;      ///< on the surface
  Eigen::Vector3d normal;     ///< outward
  double inner_length;        ///< length of the solid behind `start`; infinite when the surface is open there
  Eigen::Vector3d end;        ///< where the solid ends; `start` when it does not
  std::int32_t end_triangle;  ///< -1 when it does not end
  double ambient_visibility =
      1;                ///< share of the half space in front of `start` in which nothing of the shape is seen
  double exposure = 1;  ///< 1 where `start` looks into the open, 0 where into a hollow of the shape itself
  double end_exposure = 1;  ///< the same around `end`
};

/// `count` chords, spread over the triangles by area, and one more in each patch without. `patch` is a number
/// per triangle; openness at the end of a chord is that of the patch there.
std::vector<Chord> chords(const Shape& shape, const SurfaceGraph& graph,
                          const std::vector<std::int32_t>& patch, int count);

}  // namespace stackabilization::detail
