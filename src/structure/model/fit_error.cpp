#include "structure/model/fit_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Number of samples. The sampling error is smaller than visible differences between the errors of cuboid and
/// cylinder.
constexpr int samples_of_part = 768;

/// Square of the distance in a half plane (height, distance from the axis) to the segment from a to b.
double square_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d edge = b - a;
  const double length = edge.squaredNorm();
  const double t = length > 0 ? std::clamp((point - a).dot(edge) / length, 0.0, 1.0) : 0.0;
  return (point - a - t * edge).squaredNorm();
}

/// One frustum of a generalized cylinder.
struct Frustum {
  Eigen::Vector3d base, axis;  ///< unit axis
  double height, low, high;    ///< radii

  double area() const { return std::numbers::pi * (low + high) * std::hypot(height, high - low); }
};

Frustum frustum(const GeneralizedCylinder& cylinder, Eigen::Index i) {
  const Eigen::Index next = (i + 1) % cylinder.centres.rows();
  const Eigen::Vector3d base = cylinder.centres.row(i).transpose();
  const Eigen::Vector3d step = cylinder.centres.row(next).transpose() - base;
  return {base, step.normalized(), step.norm(), cylinder.radii(i), cylinder.radii(next)};
}

Eigen::Index frustum_count(const GeneralizedCylinder& cylinder) {
  return cylinder.centres.rows() - (cylinder.closed ? 0 : 1);
}

/// Points spread evenly over discs and frusta: the radical inverse of the golden ratio runs across, the
/// golden angle around.
struct Spiral {
  int k = 0;

  double across() { return std::fmod(0.5 + ++k * (std::numbers::phi - 1), 1.0); }
  double around() const { return k * 2 * std::numbers::pi * (2 - std::numbers::phi); }
};

Eigen::Vector3d around_axis(const Eigen::Vector3d& axis, double angle) {
  const Frame frame = frame_of(Direction(axis));
  return frame.u * std::cos(angle) + frame.v * std::sin(angle);
}

int share(double area, double total) {
  return static_cast<int>(std::ceil(samples_of_part * area / total));
}

Points surface_points(const GeneralizedCylinder& cylinder) {
  const Eigen::Index n = frustum_count(cylinder);
  const Eigen::Index last = cylinder.centres.rows() - 1;
  const auto disc = [](double radius) { return std::numbers::pi * radius * radius; };
  double total = cylinder.closed ? 0 : disc(cylinder.radii(0)) + disc(cylinder.radii(last));
  for (Eigen::Index i = 0; i < n; ++i) total += frustum(cylinder, i).area();

  std::vector<Eigen::Vector3d> points;
  Spiral spiral;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Frustum piece = frustum(cylinder, i);
    for (int k = share(piece.area(), total); k > 0; --k) {
      const double t = spiral.across();
      points.push_back(piece.base + t * piece.height * piece.axis +
                       std::lerp(piece.low, piece.high, t) * around_axis(piece.axis, spiral.around()));
    }
  }
  if (!cylinder.closed)
    for (const Eigen::Index end : {Eigen::Index{0}, last}) {
      const Eigen::Vector3d axis = frustum(cylinder, end == 0 ? 0 : n - 1).axis;
      for (int k = share(disc(cylinder.radii(end)), total); k > 0; --k) {
        const double radius = cylinder.radii(end) * std::sqrt(spiral.across());
        points.push_back(cylinder.centres.row(end).transpose() + radius * around_axis(axis, spiral.around()));
      }
    }
  Points rows(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k)
    rows.row(static_cast<Eigen::Index>(k)) = points[k].transpose();
  return rows;
}

Points surface_points(const OrientedBox& box) {
  const Cuboid cuboid = cuboid_of(box);
  Shape shape;
  shape.vertices = cuboid.corners;
  shape.triangles.resize(12, 3);
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> ring = cuboid_face(face);
    shape.triangles.row(2 * face) << ring[0], ring[1], ring[2];
    shape.triangles.row(2 * face + 1) << ring[0], ring[2], ring[3];
  }
  return surface_samples(shape, samples_of_part).points;
}

std::vector<Frustum> frusta_of(const GeneralizedCylinder& cylinder) {
  std::vector<Frustum> frusta;
  for (Eigen::Index i = 0; i < frustum_count(cylinder); ++i) frusta.push_back(frustum(cylinder, i));
  return frusta;
}

/// Skips frusta that are certainly farther than the nearest one so far, with a margin for rounding. The
/// result is the same as without skipping.
double distance_to_frusta(const std::vector<Frustum>& frusta, bool closed, const Eigen::Vector3d& point) {
  constexpr double certainly = 1 + tolerance::relative;
  double least = std::numeric_limits<double>::infinity();  // squared
  for (std::size_t i = 0; i < frusta.size(); ++i) {
    const Frustum& piece = frusta[i];
    const Eigen::Vector3d from = point - piece.base;
    const double along = piece.axis.dot(from);
    const double beyond = std::max({0.0, -along, along - piece.height});
    if (beyond * beyond > certainly * least) continue;
    const Eigen::Vector2d place(along, (from - along * piece.axis).norm());
    const Eigen::Vector2d low(0, piece.low), high(piece.height, piece.high);
    least = std::min(least, square_to_segment(place, low, high));
    if (i == 0 && !closed) least = std::min(least, square_to_segment(place, {0, 0}, low));
    if (i + 1 == frusta.size() && !closed)
      least = std::min(least, square_to_segment(place, {piece.height, 0}, high));
  }
  return std::sqrt(least);
}

auto distance_to(const OrientedBox& box) {
  return [&box](const Eigen::Vector3d& point) { return distance_to_surface(box, point); };
}

auto distance_to(const GeneralizedCylinder& cylinder) {
  return [frusta = frusta_of(cylinder), closed = cylinder.closed](const Eigen::Vector3d& point) {
    return distance_to_frusta(frusta, closed, point);
  };
}

template <class Solid>
double mean_square_to(const Solid& solid, const Points& points) {
  const auto distance_of = distance_to(solid);
  double sum = 0;
  for (const auto& point : points.rowwise()) {
    const double distance = distance_of(Eigen::Vector3d(point.transpose()));
    sum += distance * distance;
  }
  return sum / static_cast<double>(points.rows());
}

template <class Solid>
double two_sided(const Solid& solid, const FitSurface& part, double enough) {
  constexpr Eigen::Index points_at_a_time = 64;
  const double there = mean_square_to(solid, part.samples.points);
  const Points points = surface_points(solid);
  double back = 0;
  const auto so_far = [&] { return std::sqrt((there + back / static_cast<double>(points.rows())) / 2); };
  for (Eigen::Index k = 0; k < points.rows(); ++k) {
    // Sums only grow, also when they are rounded.
    if (k % points_at_a_time == 0 && so_far() >= enough) return std::numeric_limits<double>::infinity();
    const double distance = part.index.nearest(points.row(k).transpose()).distance;
    back += distance * distance;
  }
  return so_far();
}

}  // namespace

FitSurface::FitSurface(const Shape& part)
    : shape(part), index(part), samples(surface_samples(part, samples_of_part)) {}

double distance_to_surface(const OrientedBox& box, const Eigen::Vector3d& point) {
  const Eigen::Vector3d beyond = (box.axes.transpose() * (point - box.centre)).cwiseAbs() - box.half_extents;
  return beyond.maxCoeff() > 0 ? beyond.cwiseMax(0).norm() : -beyond.maxCoeff();
}

double distance_to_surface(const GeneralizedCylinder& cylinder, const Eigen::Vector3d& point) {
  return distance_to_frusta(frusta_of(cylinder), cylinder.closed, point);
}

double distance_to_surface(const OrientedBox& box, const FitSurface& part) {
  return std::sqrt(mean_square_to(box, part.samples.points));
}

double fit_error(const OrientedBox& box, const FitSurface& part) {
  return two_sided(box, part, std::numeric_limits<double>::infinity());
}

double fit_error(const GeneralizedCylinder& cylinder, const FitSurface& part, double enough) {
  return two_sided(cylinder, part, enough);
}

}  // namespace stackabilization::detail
