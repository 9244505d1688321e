#include "mesh/box_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/planar.h"

namespace stackabilization::detail {

namespace {

Eigen::Vector2d quarter_turn(const Eigen::Vector2d& v) {
  return {-v.y(), v.x()};
}

/// Turns v clockwise by right angles.
Eigen::Vector2d turned_back(const Eigen::Vector2d& v, std::size_t right_angles) {
  const Eigen::Vector2d even = right_angles < 2 ? v : Eigen::Vector2d(-v);
  return right_angles % 2 == 0 ? even : Eigen::Vector2d(even.y(), -even.x());
}

/// Four calipers around a convex polygon: below, right of, above and left of it, when the axis points right.
class Calipers {
 public:
  explicit Calipers(const Eigen::Matrix2Xd& polygon) : polygon_(polygon), axis_(side(0).normalized()) {
    Eigen::Vector2d along = axis_;
    Eigen::Index corner = 1;
    for (std::size_t k = 0; k < 4; ++k) {
      corners_[k] = corner < polygon.cols() ? corner : 0;
      look_ahead(k);
      while (corner < polygon.cols() && side(corner).dot(along) > 0) ++corner;
      along = quarter_turn(along);
    }
  }

  const Eigen::Vector2d& axis() const { return axis_; }
  /// Returns the caliper on which a side lies. Its corner is the end of that side.
  std::size_t flush() const { return flush_; }
  /// Returns the column of the corner that a caliper touches.
  Eigen::Index corner(std::size_t caliper) const { return corners_[caliper]; }
  /// Turns the axis until another side of the polygon lies on a caliper.
  void turn() {
    flush_ = 0;
    for (std::size_t k = 1; k < 4; ++k)
      if (cross(ahead_[k], ahead_[flush_]) > 0) flush_ = k;
    axis_ = ahead_[flush_].normalized();
    corners_[flush_] = next(corners_[flush_]);
    look_ahead(flush_);
  }

 private:
  Eigen::Index next(Eigen::Index corner) const { return corner + 1 < polygon_.cols() ? corner + 1 : 0; }
  Eigen::Vector2d side(Eigen::Index k) const { return polygon_.col(next(k)) - polygon_.col(k); }
  void look_ahead(std::size_t caliper) { ahead_[caliper] = turned_back(side(corners_[caliper]), caliper); }

  const Eigen::Matrix2Xd& polygon_;
  Eigen::Vector2d axis_;
  std::size_t flush_ = 0;
  std::array<Eigen::Index, 4> corners_{};
  std::array<Eigen::Vector2d, 4>
      ahead_;  ///< sides that follow the corners, turned by right angles to the axis
};

}  // namespace

BoxView::BoxView(const HullSupport& hull, const Eigen::Vector3d& normal, double unit)
    : frame_(frame_of(Direction(normal))) {
  const Eigen::VectorXd heights = hull.heights_along(frame_.w);
  Eigen::Index top = 0, bottom = 0;
  heights.maxCoeff(&top);
  heights.minCoeff(&bottom);
  height_ = unit * frame_.to_local((hull.points().row(top) - hull.points().row(bottom)).transpose());
  const Silhouette outline = hull.silhouette(frame_);
  if (outline.polygon.cols() < 3) return;  // seen edge on
  const Eigen::Matrix2Xd polygon = unit * outline.polygon;
  Calipers calipers(polygon);
  const std::size_t m = outline.corners.size();
  std::vector<Eigen::Vector3d> points;
  points.reserve(m);
  for (std::size_t k = 0; k < m; ++k)
    points.emplace_back(polygon(0, k), polygon(1, k), unit * heights[outline.corners[k]]);
  const auto point = [&](std::size_t caliper) -> const Eigen::Vector3d& {
    return points[static_cast<std::size_t>(calipers.corner(caliper))];
  };
  const Eigen::Vector2d end = quarter_turn(calipers.axis());
  turns_.reserve(m);
  for (std::size_t k = 0; k < m; ++k) {
    const std::size_t flush = calipers.flush();
    const Eigen::Index corner = calipers.corner(flush);
    const Eigen::Vector3d& start = points[corner == 0 ? m - 1 : static_cast<std::size_t>(corner) - 1];
    Turn turn{calipers.axis(), end, point(flush) - start, flush, point(1) - point(3), point(2) - point(0)};
    if (k + 1 < m) {
      calipers.turn();
      turn.to = calipers.axis();
    }
    turns_.push_back(turn);
  }
  volume_ = height_.z() * least([](const Turn& turn, const Eigen::Vector2d& axis) {
              return turn.along.head<2>().dot(axis) * turn.across.head<2>().dot(quarter_turn(axis));
            });
}

template <typename Product>
double BoxView::least(const Product& product) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Turn& turn : turns_) least = std::min({least, product(turn, turn.from), product(turn, turn.to)});
  return turns_.empty() ? 0 : std::max(least, 0.0);
}

double BoxView::bound_along(const Eigen::Vector3d& other) const {
  const Eigen::Vector3d local = frame_.to_local(other);
  const double cosine = local.z(), sine = local.head<2>().norm();
  const double height = height_.dot(local);
  if (cosine <= 0 || height <= 0) return 0;
  const Eigen::Vector2d way = sine > 0 ? Eigen::Vector2d(local.head<2>() / sine) : Eigen::Vector2d::UnitX();
  const auto seen = [&](const Eigen::Vector3d& span) -> Eigen::Vector2d {
    return span.head<2>() + way * ((cosine - 1) * span.head<2>().dot(way) - sine * span.z());
  };
  const auto area = [&](const Turn& turn, const Eigen::Vector2d& axis) {
    return std::max(0.0, seen(turn.along).dot(axis)) *
           std::max(0.0, seen(turn.across).dot(quarter_turn(axis)));
  };
  // One turn ends where the next one begins. Bounds of both hold at every axis, so that they may change
  // anywhere: where they did along n, or where the side between them is flush along `other`.
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < turns_.size(); ++k) {
    const Turn &turn = turns_[k], &before = turns_[k == 0 ? turns_.size() - 1 : k - 1];
    const auto change = [&](const Eigen::Vector2d& axis) {
      return std::min(area(turn, axis), area(before, k == 0 ? quarter_turn(axis) : axis));
    };
    const double here = change(turn.from);
    if (here >= least) continue;
    const Eigen::Vector2d axis = turned_back(seen(turn.side), turn.caliper).stableNormalized();
    least = std::min(least, std::max(here, change(axis)));
  }
  return turns_.empty() ? 0 : height * least;
}

double BoxView::bound_within(double angle) const {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const double height = height_.z() * cosine;
  if (height <= 0) return 0;
  const Eigen::Vector2d tilt = height_.head<2>() / height;
  const auto extent = [&](const Eigen::Vector3d& span, const Eigen::Vector2d& axis) {
    return span.head<2>().dot(axis) - (1 - cosine) * span.head<2>().norm();
  };
  return height * least([&](const Turn& turn, const Eigen::Vector2d& axis) {
           const double along = extent(turn.along, axis), across = extent(turn.across, quarter_turn(axis));
           if (along <= 0 || across <= 0) return 0.0;
           // Shares of the extents that a tilt takes, for each unit of its sine: together by `first`, of
           // which no direction of the tilt takes more, and by products.
           const double a = turn.along.z() / along, b = turn.across.z() / across;
           const double first = (a * axis + b * quarter_turn(axis) - tilt).norm(), c = tilt.norm(),
                        d = std::abs(a), e = std::abs(b);
           return along * across *
                  std::max(0.0, 1 - sine * (first + sine * (c * d + c * e + d * e + sine * c * d * e)));
         });
}

}  // namespace stackabilization::detail
