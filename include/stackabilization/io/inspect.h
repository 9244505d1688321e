#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/io/read.h"

namespace stackabilization {

/// What `inspect` looks for besides what is cheap.
struct InspectOptions {
  /// Whether pairs of triangles are counted that intersect elsewhere than in what they share.
  enum class SelfIntersections { skip, count };
  /// Counting costs seconds on large meshes.
  SelfIntersections self_intersections = SelfIntersections::skip;
};

/// What `inspect` finds. Vertices with equal coordinates count as one wherever neighbourhood matters, because
/// many formats repeat them. All counts are exact.
struct Findings {
  std::int64_t vertices = 0;               ///< Rows of the vertex matrix.
  std::int64_t triangles = 0;              ///< Rows of the triangle matrix.
  std::int64_t parts = 0;                  ///< Named parts.
  std::int64_t components = 0;             ///< Sets of triangles connected through common points.
  std::int64_t distinct_points = 0;        ///< Different coordinates among the vertices that triangles use.
  std::int64_t unreferenced_vertices = 0;  ///< Vertices that no triangle uses.
  std::int64_t degenerate_faces = 0;       ///< Triangles of exactly zero area.
  std::int64_t duplicate_faces = 0;        ///< Triangles whose three points an earlier triangle has already.
  std::int64_t boundary_edges = 0;         ///< Edges of one triangle.
  std::int64_t non_manifold_edges = 0;     ///< Edges of three and more triangles.
  /// Edges of two and more triangles that do not run through it equally often in both directions.
  std::int64_t inconsistent_edges = 0;
  std::optional<std::int64_t> self_intersections;  ///< Pairs; empty unless asked for.

  bool closed = false;  ///< No boundary edge.
  /// Signed volume in model units cubed; empty unless closed and without inconsistent edges.
  std::optional<double> volume;
  bool oriented_outward = false;  ///< There is a volume and it is positive.

  Eigen::Vector3d lower = Eigen::Vector3d::Zero();  ///< Box of the vertices that triangles use, model units.
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();  ///< Opposite corner of that box.
  Unit unit = Unit::unknown;                        ///< As stated by the file or the user.

  std::optional<Axis> likely_up;  ///< Empty when several axes fit equally well.
  std::string up_reason;          ///< One clause that says why.
};

/// Looks a shape over: O(m log m), deterministic. Throws InputError when `shape` is invalid.
Findings inspect(const Shape& shape, const InspectOptions& options = {});

/// One line: counts, extents and what is wrong, if anything.
std::string brief(const Findings& findings);

/// Several lines, every field.
std::string report(const Findings& findings);

}  // namespace stackabilization
