#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/io/read.h"

namespace stackabilization {

/// Optional checks of `inspect`.
struct InspectOptions {
  /// Whether `inspect` counts the self-intersections: pairs of triangles that intersect outside their common
  /// vertices and edges.
  enum class SelfIntersections { skip, count };
  /// Counting takes seconds for large meshes.
  SelfIntersections self_intersections = SelfIntersections::skip;
};

/// Result of `inspect`. Adjacency is determined after welding of vertices with equal coordinates, because
/// many formats repeat vertices. All counts are exact.
struct Findings {
  std::int64_t vertices = 0;               ///< rows of the vertex matrix
  std::int64_t triangles = 0;              ///< rows of the triangle matrix
  std::int64_t parts = 0;                  ///< named parts
  std::int64_t components = 0;             ///< sets of triangles connected through common points
  std::int64_t distinct_points = 0;        ///< different coordinates of vertices that triangles use
  std::int64_t unreferenced_vertices = 0;  ///< vertices that no triangle uses
  std::int64_t degenerate_faces = 0;       ///< triangles of exactly zero area
  std::int64_t duplicate_faces = 0;        ///< triangles with the same three points as an earlier triangle
  std::int64_t boundary_edges = 0;         ///< edges with one triangle
  std::int64_t non_manifold_edges = 0;     ///< edges with three and more triangles
  /// Edges with two and more triangles that do not traverse the edge equally often in both directions.
  std::int64_t inconsistent_edges = 0;
  std::optional<std::int64_t> self_intersections;  ///< pairs of triangles; empty unless requested

  bool closed = false;  ///< whether there is no boundary edge
  /// Signed volume, model units cubed; empty unless closed and without inconsistent edges.
  std::optional<double> volume;
  bool oriented_outward = false;  ///< whether there is a volume and it is positive

  /// Lower corner of the box around the vertices that triangles use, model units.
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();
  /// Upper corner of that box.
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();
  Unit unit = Unit::unknown;  ///< unit according to the file or the user
  /// Unit in which the shape would be as long as an object (4 mm to 50 m), where `unit` is known and gives
  /// another size; empty otherwise. Files of metres that are read as millimetres are found by it.
  std::optional<Unit> likely_unit;

  std::optional<Axis> likely_up;  ///< probable up axis; empty when several axes fit equally well
  std::string up_reason;          ///< one clause with the reason for `likely_up`
};

/// Examines a shape: O(m log m), deterministic. Throws InputError when `shape` is invalid.
Findings inspect(const Shape& shape, const InspectOptions& options = {});

/// Returns one line with counts, extents and defects.
std::string brief(const Findings& findings);

/// Returns several lines with all members of `findings`.
std::string report(const Findings& findings);

}  // namespace stackabilization
