#include "stackabilization/io/inspect.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/disjoint_sets.h"
#include "mesh/point_index.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/exact_triangles.h"

namespace stackabilization {

namespace {

using Corners = std::array<std::int32_t, 3>;

class Inspector {
 public:
  explicit Inspector(const Shape& shape) : shape_(shape) {}

  Findings inspect(const InspectOptions& options) {
    findings_.vertices = shape_.vertex_count();
    findings_.triangles = shape_.triangle_count();
    findings_.parts = shape_.part_count();
    findings_.unit = shape_.unit;
    weld();
    count_faces();
    count_edges();
    measure_volume();
    find_up();
    if (options.self_intersections == InspectOptions::SelfIntersections::count)
      findings_.self_intersections = count_self_intersections(index_.points(), triangles_);
    return findings_;
  }

 private:
  const Eigen::Vector3d& point(std::int32_t index) const {
    return index_.points()[static_cast<std::size_t>(index)];
  }

  void weld() {
    std::vector<std::int32_t> point_of(static_cast<std::size_t>(shape_.vertex_count()), -1);
    triangles_.reserve(static_cast<std::size_t>(shape_.triangle_count()));
    for (Eigen::Index t = 0; t < shape_.triangle_count(); ++t) {
      Corners& corners = triangles_.emplace_back();
      for (int corner = 0; corner < 3; ++corner) {
        std::int32_t& welded = point_of[static_cast<std::size_t>(shape_.triangles(t, corner))];
        if (welded < 0) welded = index_.insert(shape_.corner(t, corner));
        corners[static_cast<std::size_t>(corner)] = welded;
      }
    }
    findings_.distinct_points = static_cast<std::int64_t>(index_.points().size());
    findings_.unreferenced_vertices = std::count(point_of.begin(), point_of.end(), -1);
    findings_.lower = findings_.upper = point(0);
    for (const Eigen::Vector3d& p : index_.points()) {
      findings_.lower = findings_.lower.cwiseMin(p);
      findings_.upper = findings_.upper.cwiseMax(p);
    }
  }

  void count_faces() {
    DisjointSets components(index_.points().size());
    std::vector<Corners> sorted = triangles_;
    for (Corners& corners : sorted) {
      for (const std::size_t k : {1, 2})
        components.join(static_cast<std::size_t>(corners[0]), static_cast<std::size_t>(corners[k]));
      findings_.degenerate_faces += are_collinear(point(corners[0]), point(corners[1]), point(corners[2]));
      std::sort(corners.begin(), corners.end());
    }
    findings_.components = static_cast<std::int64_t>(components.count());
    std::sort(sorted.begin(), sorted.end());
    findings_.duplicate_faces = sorted.end() - std::unique(sorted.begin(), sorted.end());
  }

  /// Edges as (lower point, higher point, direction), sorted so that those of one edge are neighbours.
  void count_edges() {
    struct HalfEdge {
      std::int32_t low, high;
      std::int32_t direction;
    };
    std::vector<HalfEdge> edges;
    edges.reserve(3 * triangles_.size());
    for (const Corners& corners : triangles_)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t from = corners[i];
        const std::int32_t to = corners[(i + 1) % 3];
        if (from != to) edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
      }
    std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
      return a.low != b.low ? a.low < b.low : a.high < b.high;
    });
    for (auto edge = edges.begin(); edge != edges.end();) {
      std::int64_t uses = 0;
      std::int64_t balance = 0;
      const HalfEdge first = *edge;
      for (; edge != edges.end() && edge->low == first.low && edge->high == first.high; ++edge) {
        ++uses;
        balance += edge->direction;
      }
      findings_.boundary_edges += uses == 1;
      findings_.non_manifold_edges += uses > 2;
      findings_.inconsistent_edges += uses > 1 && balance != 0;
    }
    findings_.closed = findings_.boundary_edges == 0;
  }

  void measure_volume() {
    if (!findings_.closed || findings_.inconsistent_edges > 0) return;
    const Eigen::Vector3d centre = findings_.lower / 2 + findings_.upper / 2;
    double volume = 0;
    for (const Corners& corners : triangles_) {
      const Eigen::Vector3d a = point(corners[0]) - centre;
      const Eigen::Vector3d b = point(corners[1]) - centre;
      const Eigen::Vector3d c = point(corners[2]) - centre;
      volume += a.dot(b.cross(c)) / 6;
    }
    findings_.volume = volume;
    findings_.oriented_outward = volume > 0;
  }

  /// Centre of the surface, in fractions of the box; 1/2 along axes without extent.
  Eigen::Vector3d relative_centroid(const Eigen::Array3d& extent) const {
    const Eigen::Array3d scale = (extent > 0).select(extent, 1);
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double total = 0;
    for (const Corners& corners : triangles_) {
      const Eigen::Vector3d a = (point(corners[0]) - findings_.lower).array() / scale;
      const Eigen::Vector3d b = (point(corners[1]) - findings_.lower).array() / scale;
      const Eigen::Vector3d c = (point(corners[2]) - findings_.lower).array() / scale;
      const double area = (b - a).cross(c - a).norm();
      moment += area * (a + b + c) / 3;
      total += area;
    }
    if (!(total > 0)) return Eigen::Vector3d::Constant(0.5);
    return moment / total;
  }

  /// How well the shape stands on its low end along `axis`: the part of the footprint that the lowest points
  /// span, or nothing when they do not carry the centre.
  double support(Eigen::Index axis, const Eigen::Array3d& extent, const Eigen::Vector3d& centroid) const {
    const Eigen::Array3d scale = (extent > 0).select(extent, 1);
    const double highest = findings_.lower[axis] + tolerance::support_slab * extent[axis];
    Eigen::Array3d low = Eigen::Array3d::Ones();
    Eigen::Array3d high = Eigen::Array3d::Zero();
    for (const Eigen::Vector3d& p : index_.points()) {
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
    if (others.maxCoeff() < tolerance::clear_lead * most) findings_.likely_up = static_cast<Axis>(best);
  }

  const Shape& shape_;
  Findings findings_;
  PointIndex index_;
  std::vector<Corners> triangles_;  ///< Of welded points.
};

}  // namespace

Findings inspect(const Shape& shape, const InspectOptions& options) {
  validate(shape);
  return Inspector(shape).inspect(options);
}

}  // namespace stackabilization
