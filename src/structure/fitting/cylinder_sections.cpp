#include "structure/fitting/cylinder_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/tolerances.h"
#include "structure/model/canonical_axes.h"

namespace stackabilization::detail {

namespace {

/// Directions over which an outline is averaged.
constexpr int direction_count = 48;
/// Sectors in each of which the outline of a body of revolution reaches its radius: polygons of eight sides
/// have a corner in every one.
constexpr int sector_count = 8;
/// Ratio to the radius of most sectors from which on what reaches farther sticks out.
constexpr double sticks_out = 1.01;

using OutlineSegment = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

/// Segments of the intersection of the triangles with the plane third coordinate = height, seen from the
/// axis.
class Sections {
 public:
  Sections(const Shape& part, const AxisLine& axis, std::vector<double> heights)
      : frame_(frame_of(Direction(axis.direction))),
        heights_(std::move(heights)),
        segments_(heights_.size()) {
    for (Eigen::Index t = 0; t < part.triangle_count(); ++t) {
      Eigen::Matrix3d local;
      for (int k = 0; k < 3; ++k) local.col(k) = frame_.to_local(part.corner(t, k) - axis.point);
      const Range range{local.row(2).minCoeff(), local.row(2).maxCoeff()};
      const auto first = std::lower_bound(heights_.begin(), heights_.end(), range.low);
      for (auto height = first; height != heights_.end() && *height <= range.high; ++height)
        cut(local, *height, segments_[static_cast<std::size_t>(height - heights_.begin())]);
    }
  }

  /// Returns the largest distance from the axis, without what sticks out on one side, such as the stub of a
  /// handle; NaN where the intersection is empty.
  double outermost(std::size_t section) const {
    std::array<double, sector_count> farthest{};
    const auto reach = [&](double angle, double distance) {
      const double turn = angle / (2 * std::numbers::pi);
      double& in_sector =
          farthest.at(static_cast<std::size_t>((turn - std::floor(turn)) * sector_count) % sector_count);
      in_sector = std::max(in_sector, distance);
    };
    for (const auto& [a, b] : segments_[section])
      for (const Eigen::Vector2d& corner : {a, b}) reach(std::atan2(corner.y(), corner.x()), corner.norm());
    for (int k = 0; k < direction_count; ++k) reach(angle_of(k), along(section, angle_of(k)));
    std::sort(farthest.begin(), farthest.end(), std::greater<>());
    const auto met =
        std::count_if(farthest.begin(), farthest.end(), [](double reached) { return reached > 0; });
    if (segments_[section].empty()) return std::numeric_limits<double>::quiet_NaN();
    if (met == 0) return 0;
    const double usual = farthest.at(static_cast<std::size_t>(met - 1) / 2);
    return farthest[0] > sticks_out * usual ? usual : farthest[0];
  }

  /// Returns the mean, over the directions that meet the outline, of the distance of its farthest point; NaN
  /// where the intersection is empty.
  double mean(std::size_t section) const {
    const std::vector<double> distances = farthest_points(section);
    double sum = 0;
    for (const double distance : distances) sum += distance;
    return distances.empty() ? std::numeric_limits<double>::quiet_NaN()
                             : sum / static_cast<double>(distances.size());
  }

  /// Returns the centroid of the outline, in the plane orthogonal to the axis; NaN where the intersection is
  /// empty.
  Eigen::Vector2d middle(std::size_t section) const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double length = 0;
    for (const auto& [a, b] : segments_[section]) {
      sum += (b - a).norm() / 2 * (a + b);
      length += (b - a).norm();
    }
    return sum / length;
  }

 private:
  static void cut(const Eigen::Matrix3d& local, double height, std::vector<OutlineSegment>& segments) {
    std::vector<Eigen::Vector2d> ends;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d a = local.col(k), b = local.col((k + 1) % 3);
      if ((a.z() <= height) == (b.z() <= height)) continue;
      ends.push_back(a.head<2>() + (height - a.z()) / (b.z() - a.z()) * (b - a).head<2>());
    }
    if (ends.size() == 2) segments.emplace_back(ends[0], ends[1]);
  }

  /// Returns the distance of the farthest point of the outline in every direction that meets it.
  std::vector<double> farthest_points(std::size_t section) const {
    std::vector<double> distances;
    for (int k = 0; k < direction_count; ++k)
      if (const double farthest = along(section, angle_of(k)); farthest > 0) distances.push_back(farthest);
    return distances;
  }

  static double angle_of(int direction) { return (direction + 0.5) * 2 * std::numbers::pi / direction_count; }

  /// Returns the distance of the farthest point of the outline in a direction; 0 where it is not met.
  double along(std::size_t section, double angle) const {
    double farthest = 0;
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle)), across(-ray.y(), ray.x());
    for (const auto& [a, b] : segments_[section]) {
      const double left = across.dot(a), right = across.dot(b);
      if ((left > 0) == (right > 0)) continue;
      farthest = std::max(farthest, ray.dot(a + left / (left - right) * (b - a)));
    }
    return farthest;
  }

  Frame frame_;
  std::vector<double> heights_;
  std::vector<std::vector<OutlineSegment>> segments_;
};

/// Interpolates radii linearly where the intersection is empty, as between shells.
void fill_gaps(Eigen::VectorXd& radii) {
  Eigen::Index known = -1;
  for (Eigen::Index i = 0; i < radii.size(); ++i) {
    if (std::isnan(radii(i))) continue;
    for (Eigen::Index gap = known + 1; gap < i; ++gap)
      radii(gap) = known < 0 ? radii(i)
                             : std::lerp(radii(known), radii(i),
                                         static_cast<double>(gap - known) / static_cast<double>(i - known));
    known = i;
  }
  if (known >= 0) radii.tail(radii.size() - known - 1).setConstant(radii(known));
}

/// Enlarges the radii at the ends. The plane at a slanted or rounded end cuts only a tip of the part; the
/// radius is at least that of the wall, extended straight but not wider.
void hold_ends(Eigen::VectorXd& radii) {
  const Eigen::Index n = radii.size();
  const auto held = [&](Eigen::Index end, Eigen::Index next, Eigen::Index after) {
    return std::max(radii(end), std::min(radii(next), 2 * radii(next) - radii(after)));
  };
  const double first = held(0, 1, 2), last = held(n - 1, n - 2, n - 3);
  radii(0) = first;
  radii(n - 1) = last;
}

/// Equal steps in height over the axis point, from end to end of the part.
struct Heights {
  Range range;  ///< of the part along the axis, above the axis point
  std::vector<double> planes;

  Heights(const Shape& part, const AxisLine& axis, int sections) : range(range_along(part, axis.direction)) {
    const double offset = axis.direction.dot(axis.point);
    range = {range.low - offset, range.high - offset};
    // A plane through an end may miss the part because of rounding: the outermost two planes lie slightly
    // inside.
    for (int i = 0; i < sections; ++i)
      planes.push_back(
          std::lerp(range.low, range.high,
                    std::clamp(i / (sections - 1.0), tolerance::relative, 1 - tolerance::relative)));
  }
};

}  // namespace

std::optional<AxisLine> middle_line(const Shape& part, const AxisLine& line, int sections) {
  const AxisLine axis{line.point, canonical_sense(line.direction)};
  const Heights heights(part, axis, sections);
  const Sections cuts(part, axis, heights.planes);
  std::vector<Eigen::Vector3d> middles;
  for (std::size_t i = 0; i < heights.planes.size(); ++i)
    if (const Eigen::Vector2d middle = cuts.middle(i); middle.allFinite())
      middles.emplace_back(middle.x(), middle.y(), heights.planes[i]);
  if (2 * middles.size() < heights.planes.size()) return std::nullopt;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& middle : middles) mean += middle / static_cast<double>(middles.size());
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  double squares = 0;
  for (const Eigen::Vector3d& middle : middles) {
    slope += (middle.z() - mean.z()) * (middle - mean).head<2>();
    squares += (middle.z() - mean.z()) * (middle.z() - mean.z());
  }
  if (!(squares > 0)) return std::nullopt;
  slope /= squares;
  const Frame frame = frame_of(Direction(axis.direction));
  return AxisLine{axis.point + frame.to_world(mean), frame.to_world({slope.x(), slope.y(), 1}).normalized()};
}

std::optional<GeneralizedCylinder> straight_cylinder(const Shape& part, const AxisLine& line, int sections,
                                                     SectionRadius radius) {
  const AxisLine axis{line.point, canonical_sense(line.direction)};
  const Heights heights(part, axis, sections);
  const Sections cuts(part, axis, heights.planes);
  GeneralizedCylinder cylinder{.centres = Points(sections, 3), .radii = Eigen::VectorXd(sections)};
  for (int i = 0; i < sections; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const double height = std::lerp(heights.range.low, heights.range.high, i / (sections - 1.0));
    cylinder.centres.row(i) = (axis.point + height * axis.direction).transpose();
    cylinder.radii(i) = radius == SectionRadius::outermost ? cuts.outermost(row) : cuts.mean(row);
  }
  fill_gaps(cylinder.radii);
  hold_ends(cylinder.radii);
  const double largest = cylinder.radii.maxCoeff();
  if (!(heights.range.length() > 0) || !(largest > 0)) return std::nullopt;
  cylinder.radii = cylinder.radii.cwiseMax(min_relative_radius * largest);
  return cylinder;
}

std::optional<GeneralizedCylinder> ring_cylinder(const FitSurface& part, const AxisLine& line, int sections) {
  const AxisLine axis{line.point, canonical_sense(line.direction)};
  const Frame frame = frame_of(Direction(axis.direction));
  const auto profile = [&](const auto& row) -> Eigen::Vector2d {
    const Eigen::Vector3d local = frame.to_local(row.transpose() - axis.point);
    return {local.head<2>().norm(), local.z()};
  };
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Eigen::Index t = 0; t < part.shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d place = profile(part.shape.vertices.row(part.shape.triangles(t, k)));
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
  const Eigen::Vector2d middle = (low + high) / 2;
  double radius = 0;
  for (const auto& row : part.samples.points.rowwise()) {
    // A disc has its corners on the rim, but reaches the axis.
    if (profile(row).x() < low.x() / 2) return std::nullopt;
    radius += (profile(row) - middle).norm();
  }
  radius /= static_cast<double>(part.samples.points.rows());
  if (!(radius < middle.x())) return std::nullopt;

  GeneralizedCylinder ring{.centres = Points(sections, 3),
                           .radii = Eigen::VectorXd::Constant(sections, radius)};
  ring.closed = true;
  const Eigen::Vector3d u = orthogonal_axis(axis.direction), v = axis.direction.cross(u);
  const Eigen::Vector3d centre = axis.point + middle.y() * axis.direction;
  for (int i = 0; i < sections; ++i) {
    const double angle = i * 2 * std::numbers::pi / sections;
    ring.centres.row(i) = (centre + middle.x() * (u * std::cos(angle) + v * std::sin(angle))).transpose();
  }
  return ring;
}

}  // namespace stackabilization::detail
