#include "stackabilization/io/inspect.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/edge_table.h"
#include "mesh/surface_moments.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/mesh/exact_triangles.h"

namespace stackabilization {

namespace {

/// Height of the slab at the bottom of a shape whose points count as its support, fraction of the extent.
constexpr double support_slab = 0.01;

/// An axis is up only when the score of every other axis is below this fraction of its score.
constexpr double clear_lead = 0.9;

/// Length of what people stack, metres: from a bead to a barge.
constexpr double min_object = 0.004;
constexpr double max_object = 50;
/// Units that files are in and that readers mistake, likely ones first.
constexpr std::array<Unit, 4> common_units = {Unit::metre, Unit::millimetre, Unit::centimetre, Unit::inch};

class Inspector {
 public:
  explicit Inspector(const Shape& shape) : shape_(shape), mesh_(detail::weld(shape)) {}

  Findings inspect(const InspectOptions& options) {
    findings_.vertices = shape_.vertex_count();
    findings_.triangles = shape_.triangle_count();
    findings_.parts = shape_.part_count();
    findings_.unit = shape_.unit;
    measure_points();
    count_faces();
    count_edges();
    measure_volume();
    question_unit();
    find_up();
    if (options.self_intersections == InspectOptions::SelfIntersections::count)
      findings_.self_intersections = count_self_intersections(mesh_.points, mesh_.triangles);
    return findings_;
  }

 private:
  using Corners = std::array<Eigen::Vector3d, 3>;

  Corners corners(Eigen::Index triangle) const {
    const auto row = mesh_.triangles.row(triangle);
    return {mesh_.points.row(row(0)), mesh_.points.row(row(1)), mesh_.points.row(row(2))};
  }

  void measure_points() {
    findings_.distinct_points = mesh_.points.rows();
    findings_.unreferenced_vertices = std::count(mesh_.of_vertex.begin(), mesh_.of_vertex.end(), -1);
    findings_.lower = mesh_.points.colwise().minCoeff();
    findings_.upper = mesh_.points.colwise().maxCoeff();
  }

  void count_faces() {
    const std::vector<std::int32_t> component = detail::connected_components(mesh_);
    findings_.components = 1 + *std::max_element(component.begin(), component.end());
    findings_.degenerate_faces =
        shape_.triangle_count() - static_cast<std::int64_t>(triangles_with_area(shape_).size());
    const std::vector<std::int32_t> first = mesh_.first_copies();
    for (std::size_t face = 0; face < first.size(); ++face)
      findings_.duplicate_faces += static_cast<std::size_t>(first[face]) != face;
  }

  void count_edges() {
    const detail::EdgeTable edges(mesh_.triangles, detail::EdgeTable::Collapsed::keep);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::span<const detail::TriangleSide> sides = edges[e];
      const auto forward =
          std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.forward; });
      findings_.boundary_edges += sides.size() == 1;
      findings_.non_manifold_edges += sides.size() > 2;
      findings_.inconsistent_edges +=
          sides.size() > 1 && 2 * forward != static_cast<std::ptrdiff_t>(sides.size());
    }
    findings_.closed = findings_.boundary_edges == 0;
  }

  void measure_volume() {
    if (!findings_.closed || findings_.inconsistent_edges > 0) return;
    const Eigen::Vector3d centre = findings_.lower / 2 + findings_.upper / 2;
    double volume = 0;
    for (Eigen::Index t = 0; t < mesh_.triangles.rows(); ++t) {
      const Corners corner = corners(t);
      volume += detail::signed_volume(corner[0] - centre, corner[1] - centre, corner[2] - centre);
    }
    findings_.volume = volume;
    findings_.oriented_outward = volume > 0;
  }

  void question_unit() {
    if (shape_.unit == Unit::unknown) return;
    const double length = (findings_.upper - findings_.lower).maxCoeff();
    const auto is_object = [length](Unit unit) {
      const double metres = length * metres_per_unit(unit);
      return metres >= min_object && metres <= max_object;
    };
    if (is_object(shape_.unit)) return;
    const auto likely = std::find_if(common_units.begin(), common_units.end(), is_object);
    if (likely != common_units.end()) findings_.likely_unit = *likely;
  }

  /// Centre of the surface, in fractions of the box; 1/2 along axes without extent.
  Eigen::Vector3d relative_centroid(const Eigen::Array3d& extent) const {
    const Eigen::Array3d scale = (extent > 0).select(extent, 1);
    const auto scaled = [&](const Eigen::Vector3d& corner) -> Eigen::Vector3d {
      return (corner - findings_.lower).array() / scale;
    };
    detail::SurfaceMoments moments(Eigen::Vector3d::Zero());
    for (Eigen::Index t = 0; t < mesh_.triangles.rows(); ++t) {
      const Corners corner = corners(t);
      moments.add(scaled(corner[0]), scaled(corner[1]), scaled(corner[2]));
    }
    if (!(moments.area() > 0)) return Eigen::Vector3d::Constant(0.5);
    return moments.centre();
  }

  /// Returns the stability of the shape on its lower end along `axis`: the share of the footprint that the
  /// lowest points span, or nothing when they do not support the centre.
  double support(Eigen::Index axis, const Eigen::Array3d& extent, const Eigen::Vector3d& centroid) const {
    const Eigen::Array3d scale = (extent > 0).select(extent, 1);
    const double highest = findings_.lower[axis] + support_slab * extent[axis];
    Eigen::Array3d low = Eigen::Array3d::Ones();
    Eigen::Array3d high = Eigen::Array3d::Zero();
    for (const auto row : mesh_.points.rowwise()) {
      const Eigen::Vector3d p = row;
      if (p[axis] > highest) continue;
      const Eigen::Array3d relative = (p - findings_.lower).array() / scale;
      low = low.min(relative);
      high = high.max(relative);
    }
    const Eigen::Index u = (axis + 1) % 3;
    const Eigen::Index v = (axis + 2) % 3;
    const bool carries =
        centroid[u] >= low[u] && centroid[u] <= high[u] && centroid[v] >= low[v] && centroid[v] <= high[v];
    return carries ? (high[u] - low[u]) * (high[v] - low[v]) : 0;
  }

  void find_up() {
    const Eigen::Array3d extent = findings_.upper - findings_.lower;
    if (!extent.isFinite().all()) {
      findings_.up_reason = "the extents overflow";
      return;
    }
    const Eigen::Vector3d centroid = relative_centroid(extent);
    Eigen::Vector3d supports;
    for (Eigen::Index axis = 0; axis < 3; ++axis) supports[axis] = support(axis, extent, centroid);
    Eigen::Index best = 0;
    const double most = supports.maxCoeff(&best);
    std::string percents;
    for (const Eigen::Index axis : {0, 1, 2})
      percents += std::string(axis == 0 ? "" : ", ") + "xyz"[axis] + " " +
                  std::to_string(std::lround(100 * supports[axis])) + " %";
    findings_.up_reason =
        "part of the floor plan that it would stand on with this axis up, 0 % if it would tip over: " +
        percents;
    Eigen::Vector3d others = supports;
    others[best] = 0;
    if (others.maxCoeff() < clear_lead * most) findings_.likely_up = static_cast<Axis>(best);
  }

  const Shape& shape_;
  Findings findings_;
  detail::WeldedMesh mesh_;
};

}  // namespace

Findings inspect(const Shape& shape, const InspectOptions& options) {
  validate(shape);
  return Inspector(shape).inspect(options);
}

}  // namespace stackabilization
