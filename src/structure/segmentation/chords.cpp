#include "structure/segmentation/chords.h"

#include <CGAL/Simple_cartesian.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "mesh/surface_index.h"
#include "mesh/triangle_tree.h"

namespace stackabilization::detail {

namespace {

/// Distance of the start of a ray from the surface, fraction of the bounding-box diagonal. It prevents
/// intersections with the triangle of the sample. Thinner walls are not detected.
constexpr double lift = 0.0001;

/// Visibility in front of a sample above which its exposure is 1, and below which its exposure is 0.
constexpr double open_air = 0.9, hollow = 0.6;

/// Directions of the upper half space, each standing for the same solid angle: a spiral.
std::vector<Eigen::Vector3d> half_space(int count) {
  std::vector<Eigen::Vector3d> directions;
  constexpr double golden_angle = std::numbers::pi * 0.7639320225002102;
  for (int k = 0; k < count; ++k) {
    const double z = (k + 0.5) / count, radius = std::sqrt(1 - z * z);
    directions.emplace_back(radius * std::cos(golden_angle * k), radius * std::sin(golden_angle * k), z);
  }
  return directions;
}

class ChordCaster {
 public:
  ChordCaster(const Shape& shape, const SurfaceGraph& graph)
      : directions_(half_space(24)), tree_(shape, rows_with_area(graph)) {
    Eigen::AlignedBox3d box;
    for (const std::int32_t t : tree_.rows())
      for (int k = 0; k < 3; ++k) box.extend(shape.corner(t, k));
    lift_ = lift * box.diagonal().norm();
  }

  /// Returns the end of the solid behind a place with an outward normal, or nothing.
  std::optional<TreePoint> end(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) const {
    return tree_.first_hit(place - lift_ * normal, -normal);
  }

  void measure(Chord& chord) const {
    chord.end = chord.start;
    chord.end_triangle = -1;
    chord.inner_length = std::numeric_limits<double>::infinity();
    if (const auto hit = end(chord.start, chord.normal)) {
      chord.end = hit->point;
      chord.end_triangle = hit->triangle;
      chord.inner_length = (hit->point - chord.start).norm();
    }
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), chord.normal);
    int seen = 0;
    for (const Eigen::Vector3d& direction : directions_)
      seen += tree_.is_hit(chord.start + lift_ * chord.normal, turn * direction);
    chord.ambient_visibility = 1 - static_cast<double>(seen) / static_cast<double>(directions_.size());
    chord.exposure = std::clamp((chord.ambient_visibility - hollow) / (open_air - hollow), 0.0, 1.0);
  }

 private:
  static std::vector<std::int32_t> rows_with_area(const SurfaceGraph& graph) {
    std::vector<std::int32_t> rows;
    for (std::int32_t t = 0; t < graph.size(); ++t)
      if (graph.areas(t) > 0) rows.push_back(t);
    return rows;
  }

  std::vector<Eigen::Vector3d> directions_;
  TriangleTree<CGAL::Simple_cartesian<double>> tree_;
  double lift_ = 0;
};

void measure_ends(std::vector<Chord>& chords, const std::vector<std::int32_t>& patch) {
  const auto patches = static_cast<std::size_t>(*std::max_element(patch.begin(), patch.end())) + 1;
  std::vector<double> area(patches, 0), open_area(patches, 0);
  const auto patch_of = [&](std::int32_t t) {
    return static_cast<std::size_t>(patch[static_cast<std::size_t>(t)]);
  };
  for (const Chord& c : chords) {
    area[patch_of(c.triangle)] += c.area;
    open_area[patch_of(c.triangle)] += c.area * c.exposure;
  }
  for (Chord& c : chords)
    if (c.end_triangle >= 0)
      c.end_exposure = open_area[patch_of(c.end_triangle)] / area[patch_of(c.end_triangle)];
}

}  // namespace

std::vector<Chord> chords(const Shape& shape, const SurfaceGraph& graph,
                          const std::vector<std::int32_t>& patch, int count) {
  const double area = graph.areas.sum();
  const SurfaceSamples samples = surface_samples(shape, count);
  std::vector<Chord> result;
  std::vector<char> seen(patch.size(), 0);
  const auto add = [&](std::int32_t t, const Eigen::Vector3d& point, double share) {
    result.push_back({t, share, point, graph.normals.row(t).transpose(), 0, point, -1});
    seen[static_cast<std::size_t>(patch[static_cast<std::size_t>(t)])] = 1;
  };
  for (int k = 0; k < count; ++k)
    add(samples.triangles[static_cast<std::size_t>(k)], samples.points.row(k).transpose(), area / count);
  std::vector<std::int32_t> by_area;
  for (std::int32_t t = 0; t < graph.size(); ++t) by_area.push_back(t);
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](std::int32_t a, std::int32_t b) { return graph.areas(a) > graph.areas(b); });
  for (const std::int32_t t : by_area)
    if (graph.areas(t) > 0 && !seen[static_cast<std::size_t>(patch[static_cast<std::size_t>(t)])])
      add(t, graph.centres.row(t).transpose(), graph.areas(t));
  const ChordCaster caster(shape, graph);
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t k) { caster.measure(result[k]); });
  measure_ends(result, patch);
  return result;
}

std::vector<SurfaceLink> wall_links(const Shape& shape, const SurfaceGraph& graph) {
  const SurfaceSamples places = surface_samples(shape, wall_places);
  const ChordCaster caster(shape, graph);
  std::vector<std::int32_t> ends(places.triangles.size(), -1);
  tbb::parallel_for(std::size_t{0}, ends.size(), [&](std::size_t k) {
    const Eigen::Vector3d normal = graph.normals.row(places.triangles[k]).transpose();
    const auto end = caster.end(places.points.row(static_cast<Eigen::Index>(k)).transpose(), normal);
    if (end && graph.normals.row(end->triangle).dot(normal) < 0) ends[k] = end->triangle;
  });
  std::vector<SurfaceLink> links;
  for (std::size_t k = 0; k < ends.size(); ++k)
    if (ends[k] >= 0) links.push_back({places.triangles[k], ends[k], 0, 0});
  return links;
}

}  // namespace stackabilization::detail
