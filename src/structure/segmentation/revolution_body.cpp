#include "structure/segmentation/revolution_body.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "core/disjoint_sets.h"
#include "mesh/surface_moments.h"
#include "structure/fitting/revolution_axis.h"
#include "structure/model/fit_error.h"
#include "structure/segmentation/segment_boundaries.h"

namespace stackabilization::detail {

namespace {

/// Least share of the area in the body.
constexpr double min_body_share = 0.5;
/// Least area of an attachment, fraction of the sum of the squared lengths of the loops of its border:
/// handles have 0.3 and more, legs 3, a corner of a square plate beside its inscribed disc 0.13.
constexpr double min_slenderness = 0.2;
/// A point belongs to the body when at least this share of its images by turns about the axis lie within this
/// distance of the surface, fraction of the radius.
constexpr double min_close_share = 0.5;
constexpr double allowed_miss = 0.05;
constexpr int turn_count = 8;
/// Share of the surface within the radius: attachments reach farther.
constexpr double radius_rank = 0.9;
/// Scale of the distances of normals from the axis beyond which triangles lose their weight, fraction of the
/// diagonal: first, last, and factor from one step to the next.
constexpr double first_miss = 0.2;
constexpr double last_miss = 0.01;
constexpr double miss_step = 0.6;
/// Ratio of areas from which on another axis than that of all normals is taken.
constexpr double clearly_larger = 1.01;

bool is_connected(const SurfaceGraph& graph) {
  DisjointSets sets(static_cast<std::size_t>(graph.size()));
  for (const SurfaceLink& link : graph.links)
    sets.join(static_cast<std::size_t>(link.a), static_cast<std::size_t>(link.b));
  return sets.count() == 1;
}

/// An axis, and the area of the surface that is round about it.
struct FoundAxis {
  std::optional<AxisLine> axis;
  double area = 0;
};

/// Improves an axis. Weights of Geman and McClure leave out what is not round about it.
FoundAxis improved(std::optional<AxisLine> axis, const Shape& shape, const SurfaceGraph& graph) {
  FoundAxis found{axis, 0};
  Eigen::VectorXd weights(graph.size());
  for (double scale = first_miss; found.axis && scale >= last_miss; scale *= miss_step) {
    const double distance = scale * graph.diagonal;
    for (std::int32_t t = 0; t < graph.size(); ++t) {
      const Eigen::Vector3d normal = graph.normals.row(t).transpose();
      const Eigen::Vector3d arm = graph.centres.row(t).transpose() - found.axis->point;
      const double miss = arm.dot(found.axis->direction.cross(normal)) / distance;
      weights(t) = 1 / ((1 + miss * miss) * (1 + miss * miss));
    }
    found = {axis_of_normals(shape, weights), weights.dot(graph.areas)};
  }
  return found;
}

/// Returns the axis of the largest body of revolution that is found from the axis of all normals and from the
/// principal axes of the surface.
std::optional<AxisLine> largest_axis(const Shape& shape, const SurfaceGraph& graph) {
  FoundAxis best = improved(axis_of_normals(shape, Eigen::VectorXd::Ones(graph.size())), shape, graph);
  const SurfaceMoments moments(shape, shape.corner(0, 0));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(moments.covariance());
  for (int k = 0; k < 3; ++k) {
    const FoundAxis other =
        improved(AxisLine{moments.centre(), principal.eigenvectors().col(k)}, shape, graph);
    if (other.axis && other.area > clearly_larger * best.area) best = other;
  }
  return best.axis;
}

/// Tells the points of a surface that lie on its body of revolution about an axis.
class RoundPoints {
 public:
  RoundPoints(const FitSurface& surface, const AxisLine& axis, double radius)
      : surface_(surface), axis_(axis), allowed_(allowed_miss * radius) {
    for (int k = 0; k < turn_count; ++k)
      turns_[static_cast<std::size_t>(k)] =
          Eigen::AngleAxisd((k + 1) * 2 * std::numbers::pi * (std::numbers::phi - 1), axis.direction)
              .toRotationMatrix();
  }

  bool has(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d arm = point - axis_.point;
    int near = 0, left = turn_count;
    for (const Eigen::Matrix3d& turn : turns_) {
      near += surface_.index.nearest(axis_.point + turn * arm).distance <= allowed_;
      --left;
      if (near >= min_close_share * turn_count) return true;
      if (near + left < min_close_share * turn_count) return false;
    }
    return false;
  }

 private:
  const FitSurface& surface_;
  const AxisLine& axis_;
  std::array<Eigen::Matrix3d, turn_count> turns_;
  double allowed_;
};

/// What sticks out of the body, or not: a connected set of triangles.
struct Attachment {
  double area = 0;
  std::vector<std::int32_t> border;  ///< rows of the links to the body
};

/// Returns the attachments by their first triangles. `sets`, of one triangle each, are joined to them.
std::map<std::size_t, Attachment> attachments(const SurfaceGraph& graph, const std::vector<char>& body,
                                              DisjointSets& sets) {
  const auto ends = [](const SurfaceLink& link) {
    return std::pair(static_cast<std::size_t>(link.a), static_cast<std::size_t>(link.b));
  };
  for (const SurfaceLink& link : graph.links)
    if (const auto [a, b] = ends(link); !body[a] && !body[b]) sets.join(a, b);
  std::map<std::size_t, Attachment> found;
  for (std::size_t t = 0; t < body.size(); ++t)
    if (!body[t]) found[sets.root(t)].area += graph.areas(static_cast<Eigen::Index>(t));
  for (std::size_t row = 0; row < graph.links.size(); ++row)
    if (const auto [a, b] = ends(graph.links[row]); body[a] != body[b])
      found[sets.root(body[a] ? b : a)].border.push_back(static_cast<std::int32_t>(row));
  return found;
}

/// Returns the sum of the squared lengths of the loops that some links form. Links of one loop share corners.
double squared_loops(const Shape& shape, const SurfaceGraph& graph, const std::vector<std::int32_t>& border) {
  std::map<std::array<double, 3>, std::size_t> first_at;
  DisjointSets loops(border.size());
  for (std::size_t k = 0; k < border.size(); ++k) {
    const SurfaceLink& link = graph.links[static_cast<std::size_t>(border[k])];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const Eigen::Vector3d at = shape.corner(link.a, i);
        if (at != shape.corner(link.b, j)) continue;
        loops.join(k, first_at.emplace(std::array{at.x(), at.y(), at.z()}, k).first->second);
      }
  }
  std::vector<double> lengths(border.size(), 0);
  for (std::size_t k = 0; k < border.size(); ++k)
    lengths[loops.root(k)] += graph.links[static_cast<std::size_t>(border[k])].length;
  double sum = 0;
  for (const double length : lengths) sum += length * length;
  return sum;
}

/// Adds attachments to the body that are smaller than `min_area` or do not stick out.
void absorb_flat(const Shape& shape, const SurfaceGraph& graph, double min_area, std::vector<char>& body) {
  DisjointSets sets(body.size());
  std::set<std::size_t> flat;
  for (const auto& [first, attachment] : attachments(graph, body, sets))
    if (attachment.area < min_area ||
        attachment.area < min_slenderness * squared_loops(shape, graph, attachment.border))
      flat.insert(first);
  for (std::size_t t = 0; t < body.size(); ++t)
    if (!body[t] && flat.contains(sets.root(t))) body[t] = 1;
}

/// Moves the borders of the body to short cuts along concave edges.
void smooth(const SurfaceGraph& graph, std::vector<char>& body) {
  const std::vector<std::int32_t> part =
      with_smooth_boundaries(graph, std::vector<std::int32_t>(body.begin(), body.end()), {});
  std::copy(part.begin(), part.end(), body.begin());
}

/// Returns the distance from the axis within which `radius_rank` of the samples lie.
double radius_of(const Points& samples, const AxisLine& axis) {
  Eigen::VectorXd radii(samples.rows());
  for (Eigen::Index k = 0; k < samples.rows(); ++k)
    radii(k) = (samples.row(k).transpose() - axis.point).cross(axis.direction).norm();
  const auto rank = static_cast<Eigen::Index>(radius_rank * static_cast<double>(radii.size()));
  std::nth_element(radii.begin(), radii.begin() + rank, radii.end());
  return radii(rank);
}

bool is_round(const Shape& shape, const std::vector<char>& body) {
  std::vector<std::int32_t> rows;
  for (std::size_t t = 0; t < body.size(); ++t)
    if (body[t]) rows.push_back(static_cast<std::int32_t>(t));
  const Shape alone = extracted(shape, rows);
  return revolution_axis(FitSurface(alone)).has_value();
}

}  // namespace

std::vector<char> revolution_body(const Shape& shape, const SurfaceGraph& graph, double smallest) {
  if (!is_connected(graph)) return {};
  const std::optional<AxisLine> axis = largest_axis(shape, graph);
  if (!axis) return {};
  const FitSurface surface(shape);
  const Points& samples = surface.samples.points;
  const RoundPoints round(surface, *axis, radius_of(samples, *axis));

  std::vector<char> on_body(static_cast<std::size_t>(samples.rows()), 0);
  tbb::parallel_for(Eigen::Index{0}, samples.rows(), [&](Eigen::Index k) {
    on_body[static_cast<std::size_t>(k)] = round.has(samples.row(k).transpose());
  });
  const auto count = static_cast<double>(std::count(on_body.begin(), on_body.end(), 1));
  if (count < min_body_share * static_cast<double>(on_body.size())) return {};

  std::vector<char> body(static_cast<std::size_t>(graph.size()), 0);
  tbb::parallel_for(std::int32_t{0}, graph.size(), [&](std::int32_t t) {
    body[static_cast<std::size_t>(t)] = round.has(graph.centres.row(t).transpose());
  });
  smooth(graph, body);
  absorb_flat(shape, graph, smallest * graph.areas.sum(), body);
  const bool is_all = std::all_of(body.begin(), body.end(), [](char flag) { return flag != 0; });
  if (is_all || !is_round(shape, body)) return {};
  return body;
}

}  // namespace stackabilization::detail
