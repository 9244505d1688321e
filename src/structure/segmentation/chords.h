#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

/// Ray statistics at a surface sample: inner length along -n, ambient visibility along +n.
struct Chord {
  std::int32_t triangle;   ///< triangle of the sample
  double area;             ///< surface area that the sample represents, model units squared
  Eigen::Vector3d start;   ///< sample point on the surface
  Eigen::Vector3d normal;  ///< unit outward normal
  /// Inner length: length of the solid behind `start`; infinite when the surface is open there.
  double inner_length;
  Eigen::Vector3d end;        ///< end of the solid; `start` when the solid has no end
  std::int32_t end_triangle;  ///< triangle at `end`; -1 when the solid has no end
  /// Ambient visibility: share of the half space in front of `start` that the shape does not occlude.
  double ambient_visibility = 1;
  /// Exposure: 1 where `start` faces the outside, 0 where it faces a cavity of the shape.
  double exposure = 1;
  double end_exposure = 1;  ///< exposure around `end`
};

/// Computes `count` chords, distributed over the triangles by area, and one more in each patch that has none.
/// `patch`: patch of each triangle. The exposure at the end of a chord is the exposure of the patch there.
std::vector<Chord> chords(const Shape& shape, const SurfaceGraph& graph,
                          const std::vector<std::int32_t>& patch, int count);

/// Number of places of `wall_links`.
constexpr int wall_places = 4096;

/// Returns links of length 0 from places of the surface that stand for equal areas to the triangles at which
/// the solid behind them ends. Places behind which it has no end, or another shell begins, have no link.
std::vector<SurfaceLink> wall_links(const Shape& shape, const SurfaceGraph& graph);

}  // namespace stackabilization::detail
