#include "improvement/quality/thickness.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "core/bounding_diagonal.h"
#include "mesh/barycentric.h"
#include "mesh/ray_crossings.h"
#include "mesh/surface_index.h"
#include "mesh/surface_moments.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/exact_triangles.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using detail::Crossing;

/// Number of samples on a part in which no common sample found material.
constexpr int samples_per_part = 16;

/// Finds the material behind points of a surface.
class WallThicknessRays {
 public:
  explicit WallThicknessRays(const Shape& shape)
      : shape_(shape),
        shell_(detail::connected_components(detail::weld(shape))),
        diagonal_(bounding_diagonal(shape)),
        tree_(shape, triangles_with_area(shape)) {}

  /// Returns the probe at `point` of a triangle. Nothing unless there is material on exactly one side.
  std::optional<ThicknessProbe> probe(std::int32_t triangle, const Eigen::Vector3d& point) const;

 private:
  std::vector<Crossing> hits(std::int32_t triangle, const Eigen::Vector3d& point,
                             const Eigen::Vector3d& along) const;

  const Shape& shape_;
  std::vector<std::int32_t> shell_;  ///< shell of each triangle
  double diagonal_;
  detail::TriangleTree<Kernel> tree_;
};

/// Returns the crossings of a ray with the shell of the triangle from which the ray starts, nearest first. A
/// crossing at an edge or a corner counts once.
std::vector<Crossing> WallThicknessRays::hits(std::int32_t triangle, const Eigen::Vector3d& point,
                                              const Eigen::Vector3d& along) const {
  const double reach = tolerance::relative * diagonal_;
  std::vector<Crossing> found = detail::crossings(tree_, shape_, point, along, reach, 2 * diagonal_);
  const auto shell = [&](std::int32_t t) { return shell_[static_cast<std::size_t>(t)]; };
  std::erase_if(found, [&](const Crossing& hit) { return shell(hit.triangle) != shell(triangle); });
  detail::merge_at_edges(found, reach);
  return found;
}

std::optional<ThicknessProbe> WallThicknessRays::probe(std::int32_t triangle,
                                                       const Eigen::Vector3d& point) const {
  const Eigen::Vector3d normal = detail::unit_normal(shape_, triangle);
  const std::vector<Crossing> behind = hits(triangle, point, -normal), before = hits(triangle, point, normal);
  if (behind.size() % 2 == before.size() % 2) return std::nullopt;
  const bool outward = behind.size() % 2 == 1;
  const Crossing& far = outward ? behind.front() : before.front();
  const Eigen::Vector3d end = point + (outward ? -far.distance : far.distance) * normal;
  ThicknessProbe probe{triangle, far.triangle, detail::barycentric_weights(shape_, triangle, point),
                       detail::barycentric_weights(shape_, far.triangle, end), 0};
  probe.at_rest = thickness(probe, shape_);
  return probe;
}

/// Appends the probes of the samples at which there is material.
void find(const WallThicknessRays& finder, const SurfaceSamples& samples,
          std::vector<ThicknessProbe>& probes) {
  std::vector<std::optional<ThicknessProbe>> found(samples.triangles.size());
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t k) {
    found[k] =
        finder.probe(samples.triangles[k], samples.points.row(static_cast<Eigen::Index>(k)).transpose());
  });
  for (const auto& probe : found)
    if (probe) probes.push_back(*probe);
}

/// Returns samples on one part; none if the part has no area.
SurfaceSamples samples_of_part(const Shape& shape, std::int32_t part) {
  std::vector<std::int32_t> rows;
  double area = 0;
  for (std::int32_t t = 0; t < shape.triangle_count(); ++t) {
    if (shape.triangle_part[static_cast<std::size_t>(t)] != part) continue;
    rows.push_back(t);
    area += detail::area_vector(shape, t).norm();
  }
  if (!(area > 0)) return {};
  SurfaceSamples samples = surface_samples(detail::extracted(shape, rows), samples_per_part);
  for (std::int32_t& triangle : samples.triangles) triangle = rows[static_cast<std::size_t>(triangle)];
  return samples;
}

}  // namespace

std::vector<ThicknessProbe> thickness_probes(const Shape& shape, const ThicknessOptions& options) {
  if (options.probes < 1) throw UsageError("thickness needs at least one probe");
  validate(shape);
  const SurfaceSamples samples = surface_samples(shape, options.probes);
  const WallThicknessRays finder(shape);
  std::vector<ThicknessProbe> probes;
  find(finder, samples, probes);
  std::vector<char> probed(static_cast<std::size_t>(shape.part_count()), 0);
  const auto part_of = [&](const ThicknessProbe& probe) {
    return static_cast<std::size_t>(shape.triangle_part[static_cast<std::size_t>(probe.near_triangle)]);
  };
  for (const ThicknessProbe& probe : probes) probed[part_of(probe)] = 1;
  for (std::size_t part = 0; part < probed.size(); ++part)
    if (!probed[part]) find(finder, samples_of_part(shape, static_cast<std::int32_t>(part)), probes);
  return probes;
}

double thickness(const ThicknessProbe& probe, const Shape& shape) {
  return (detail::point_at(shape, probe.near_triangle, probe.near_weights) -
          detail::point_at(shape, probe.far_triangle, probe.far_weights))
      .norm();
}

}  // namespace stackabilization
