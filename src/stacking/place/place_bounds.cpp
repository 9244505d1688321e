#include "stacking/place/place_bounds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Rectangles that are examined for one cell and one side.
constexpr int max_steps = 40;
/// Width of the rectangles around points that touch, fraction of the width of a cell.
constexpr double part_near = 0.125;
/// Rectangles smaller than this fraction of the shapes are not cut further.
constexpr double finest_part = 1.0 / (1 << 14);
/// Centre and corners of a rectangle, as shares of its sides.
constexpr std::array<std::pair<double, double>, 5> samples = {{{0.5, 0.5}, {0, 0}, {1, 0}, {0, 1}, {1, 1}}};

ProjectedMesh projected(const WeldedMesh& mesh, const EdgeTable& edges, double sign, double error) {
  ProjectedMesh result{mesh.points, &mesh.triangles, &edges, error};
  result.points.col(2) *= sign;
  return result;
}

/// A box around a rectangle turned by `yaw` about the origin.
PlanarBox turned(const PlanarBox& box, double yaw) {
  const double c = std::cos(yaw), s = std::sin(yaw);
  const double x = box.x_low / 2 + box.x_high / 2, y = box.y_low / 2 + box.y_high / 2;
  const double half_x = (std::abs(c) * box.width() + std::abs(s) * box.height()) / 2;
  const double half_y = (std::abs(s) * box.width() + std::abs(c) * box.height()) / 2;
  const double turned_x = c * x - s * y, turned_y = s * x + c * y;
  return {turned_x - half_x, turned_x + half_x, turned_y - half_y, turned_y + half_y};
}

PlanarBox grown(const PlanarBox& box, double margin) {
  return {box.x_low - margin, box.x_high + margin, box.y_low - margin, box.y_high + margin};
}

/// Where the points of a rectangle of the shape can be at the places of a cell.
PlanarBox reach(const PlanarBox& part, const PlaceCell& cell) {
  PlanarBox box = cell.yaw == 0 && cell.half_turn == 0 ? part : turned(part, cell.yaw);
  if (cell.half_turn > 0) box = grown(box, part.radius() * cell.half_turn);
  return {box.x_low + cell.box.x_low, box.x_high + cell.box.x_high, box.y_low + cell.box.y_low,
          box.y_high + cell.box.y_high};
}

/// Where the points of a rectangle of the base can be, seen from the shape, at the places of a cell.
PlanarBox reach_back(const PlanarBox& part, const PlaceCell& cell) {
  const PlanarBox moved{part.x_low - cell.box.x_high, part.x_high - cell.box.x_low,
                        part.y_low - cell.box.y_high, part.y_high - cell.box.y_low};
  if (cell.yaw == 0 && cell.half_turn == 0) return moved;
  return grown(turned(moved, -cell.yaw), moved.radius() * cell.half_turn);
}

/// What a rectangle shows, and an upper bound of what its parts can show.
struct Part {
  PlanarBox box;
  double low, high;

  friend bool operator<(const Part& a, const Part& b) {
    return a.high != b.high ? a.high < b.high : a.low < b.low;
  }
};

}  // namespace

PlaceBounds::Surface::Surface(const Shape& shape, double error)
    : mesh(weld(shape)),
      edges(mesh.triangles),
      up(projected(mesh, edges, 1, error)),
      down(projected(mesh, edges, -1, error)) {}

/// One of the two ways round: rectangles of one surface, and where they can be on the other one.
class PlaceBounds::Side {
 public:
  Side(PlaceBounds& bounds, const PlaceCell& cell, bool of_shape)
      : own_(of_shape ? bounds.shape_.down : bounds.base_.up),
        other_(of_shape ? bounds.base_.up : bounds.shape_.down),
        cell_(cell),
        of_shape_(of_shape),
        margin_(tolerance::product_rounding * bounds.size_) {}
  Side(HeightBounds& own, HeightBounds& other, const PlaceCell& cell, bool of_shape, double margin)
      : own_(own), other_(other), cell_(cell), of_shape_(of_shape), margin_(margin) {}

  /// Examines parts of the rectangle until one shows `enough`: the most promising part, the most promising
  /// quarter of it and so on, then the next part.
  void search(const PlanarBox& start, double enough, CellBound& best) const {
    const double finest = finest_part * std::max(start.width(), start.height());
    std::priority_queue<Part> parts;
    parts.push(examined(start));
    take(parts.top(), best);
    if (best.low >= enough) return;
    for (int step = 0; step < max_steps && !parts.empty();) {
      Part part = parts.top();
      parts.pop();
      for (; step < max_steps && part.high >= enough; ++step) {
        if (std::max(part.box.width(), part.box.height()) <= finest) break;
        std::array<Part, 4> next;
        std::size_t i = 0;
        for (const PlanarBox& quarter : part.box.quarters()) {
          next[i] = examined(quarter);
          // The most promising one may lie at the border and show nothing, as at the top of a ramp.
          take(next[i++], best);
        }
        if (best.low >= enough) return;
        std::sort(next.begin(), next.end());
        for (i = 0; i < 3; ++i)
          if (next[i].high >= enough) parts.push(next[i]);
        part = next[3];
      }
    }
  }

  void take(const Part& part, CellBound& best) const {
    if (part.low > best.low) best = {part.low, BoundWitness{of_shape_, part.box}};
  }

  Part examined(const PlanarBox& box) const {
    const FacingBound bound = facing_closely(box).first;
    if (!bound.difference.possibly_covered()) return {box, -unbounded, -unbounded};
    return {box, bound.difference.low, std::min(bound.difference.high, limit_of_parts(box, bound.own.high))};
  }

  /// Bounds over a rectangle of the own surface, and of its sum with the other one.
  FacingBound facing(const PlanarBox& box) const {
    FacingBound bound;
    bound.own = own_.over(box);
    if (!bound.own.possibly_covered()) return bound;
    const HeightBound far = other_.over(there(box));
    bound.all_faced = far.certainly_covered();
    bound.difference = sum(bound.own, far, 0, margin_);
    return bound;
  }

  /// The same, and closer where the surfaces slide along each other; with a bound that follows the place.
  std::pair<FacingBound, LinearBound> facing_closely(const PlanarBox& box) const {
    FacingBound bound = facing(box);
    LinearBound low{bound.difference.low, {0, 0}};
    if (bound.difference.possibly_covered()) narrow(bound.difference, low, box);
    return {bound, low};
  }

  /// Where the points of a rectangle can be on the other surface.
  PlanarBox there(const PlanarBox& box) const {
    return grown(of_shape_ ? reach(box, cell_) : reach_back(box, cell_), margin_);
  }

  /// Returns what no part of the rectangle can show more than: what single places show, at the turn in the
  /// middle of the cell. With all points of the rectangle where they are at these places; for a small one,
  /// where the other surface is at the centre and the corners of what all of its points reach.
  double limit_of_parts(const PlanarBox& box, double high) const {
    const PlanarBox& shifts = cell_.box;
    const PlanarBox own = of_shape_ && cell_.yaw != 0 ? turned(box, cell_.yaw) : box;
    const PlanarBox all = of_shape_ ? PlanarBox{own.x_high + shifts.x_low, own.x_low + shifts.x_high,
                                                own.y_high + shifts.y_low, own.y_low + shifts.y_high}
                                    : PlanarBox{own.x_high - shifts.x_high, own.x_low - shifts.x_low,
                                                own.y_high - shifts.y_high, own.y_low - shifts.y_low};
    if (all.width() < 0 || all.height() < 0) return limit_at_places(box);
    const Eigen::Rotation2Dd back(of_shape_ ? 0 : -cell_.yaw);
    double lowest = unbounded;
    for (const auto& [s, t] : samples) {
      const Eigen::Vector2d point =
          back * Eigen::Vector2d(all.x_low + s * all.width(), all.y_low + t * all.height());
      lowest =
          std::min(lowest, other_.over(grown({point.x(), point.x(), point.y(), point.y()}, margin_)).high);
    }
    return high + lowest + margin_;
  }

  double limit_at_places(const PlanarBox& box) const {
    double limit = unbounded;
    for (const auto& [s, t] : samples) {
      const double x = cell_.box.x_low + s * cell_.box.width(), y = cell_.box.y_low + t * cell_.box.height();
      const PlaceCell place{{x, x, y, y}, cell_.yaw, 0};
      limit = std::min(
          limit, Side(own_, other_, place, of_shape_, margin_).facing_closely(box).first.difference.high);
    }
    return limit;
  }

  /// Takes each surface along its slope in the middle of the rectangle, of the shape. What is linear in the
  /// points of the rectangle has its mean there.
  std::pair<LinearBound, LinearBound> mean(const PlanarBox& box) const {
    const Eigen::Vector2d middle(box.x_low / 2 + box.x_high / 2, box.y_low / 2 + box.y_high / 2);
    const PlanarBox& shifts = cell_.box;
    const Eigen::Vector2d place(shifts.x_low / 2 + shifts.x_high / 2, shifts.y_low / 2 + shifts.y_high / 2);
    const Eigen::Vector2d moved = Eigen::Rotation2Dd(cell_.yaw) * middle + place;
    const Eigen::Vector2d own = own_.slope_at(middle.x(), middle.y()),
                          other = other_.slope_at(moved.x(), moved.y());
    const double steepness = own.norm() + other.norm();
    const double offset = own.dot(middle) + other.dot(moved);
    const double spread = other.norm() * box.radius() * cell_.half_turn + (1 + 8 * steepness) * margin_;
    const HeightBound both = sum(own_.over(box, own), other_.over(there(box), other), offset, spread);
    return {{both.low, other}, {both.high, other}};
  }

  /// Compares the surfaces along the slope that they have in common where they slide along each other.
  void narrow(HeightBound& bound, LinearBound& low, const PlanarBox& box) const {
    const Eigen::Vector2d slope =
        -own_.slope_at(box.x_low / 2 + box.x_high / 2, box.y_low / 2 + box.y_high / 2);
    if (slope.isZero(0)) return;
    // u(p) - slope_there . p over there, slope_there . p - slope . q for the places p of q.
    const Eigen::Vector2d slope_there = Eigen::Rotation2Dd(of_shape_ ? cell_.yaw : -cell_.yaw) * slope;
    const PlanarBox& shifts = cell_.box;
    LinearBound at_places{0, of_shape_ ? slope_there : Eigen::Vector2d(-slope)};
    at_places.centre = at_places.slope.x() * (shifts.x_low + shifts.x_high) / 2 +
                       at_places.slope.y() * (shifts.y_low + shifts.y_high) / 2;
    const double turn = slope.norm() * (turned_radius(box) * cell_.half_turn + 8 * margin_) + margin_;
    const HeightBound along =
        sum(own_.over(box, -slope), other_.over(there(box), slope_there), at_places.centre, turn);
    if (along.low > low.centre) low = {along.low, at_places.slope};
    const double spread = at_places.spread(cell_);
    bound = {std::max(bound.low, along.low - spread), std::min(bound.high, along.high + spread),
             std::max(bound.covered_low, along.covered_low - spread)};
  }

  static HeightBound sum(const HeightBound& a, const HeightBound& b, double offset, double spread) {
    return {a.low + b.low + offset - spread, a.high + b.high + offset + spread,
            a.covered_low + b.covered_low + offset - spread};
  }

  /// Largest distance from the axis of what turns.
  double turned_radius(const PlanarBox& box) const {
    if (of_shape_) return box.radius();
    const PlanarBox& shifts = cell_.box;
    return PlanarBox{box.x_low - shifts.x_high, box.x_high - shifts.x_low, box.y_low - shifts.y_high,
                     box.y_high - shifts.y_low}
        .radius();
  }

  PlanarBox box() const { return own_.box(); }

 private:
  HeightBounds& own_;
  HeightBounds& other_;
  const PlaceCell& cell_;
  bool of_shape_;
  double margin_;  ///< for the rounding of places and of heights in the frame of r
};

PlaceBounds::PlaceBounds(const LocalShapes& shapes)
    : size_(shapes.size),
      base_(shapes.base, tolerance::product_rounding * shapes.size),
      shape_(shapes.shape, tolerance::product_rounding * shapes.size) {}

CellBound PlaceBounds::bound(const PlaceCell& cell, const BoundWitness& of_cell_around) {
  CellBound best;
  const Side side(*this, cell, of_cell_around.of_shape);
  for (const PlanarBox& part : of_cell_around.part.quarters()) side.take(side.examined(part), best);
  return best;
}

CellBound PlaceBounds::bound_near(const PlaceCell& cell, const Eigen::Vector2d& of_shape,
                                  const Eigen::Vector2d& of_base) {
  CellBound best;
  const double width = std::max(cell.box.width(), cell.box.height());
  for (const bool is_of_shape : {true, false}) {
    const Side side(*this, cell, is_of_shape);
    const Eigen::Vector2d& point = is_of_shape ? of_shape : of_base;
    for (const double half : {part_near * width, part_near * part_near * width})
      side.take(side.examined({point.x() - half, point.x() + half, point.y() - half, point.y() + half}),
                best);
  }
  return best;
}

CellBound PlaceBounds::search(const PlaceCell& cell, double enough) {
  CellBound best;
  for (const bool of_shape : {true, false}) {
    const Side side(*this, cell, of_shape);
    side.search(side.box(), enough, best);
    if (best.low >= enough) break;
  }
  return best;
}

LinearBound PlaceBounds::lift(const PlaceCell& cell, const CellBound& bound) {
  if (!bound.witness) return {bound.low, {0, 0}};
  const LinearBound low =
      Side(*this, cell, bound.witness->of_shape).facing_closely(bound.witness->part).second;
  return low.centre > bound.low ? low : LinearBound{bound.low, {0, 0}};
}

std::pair<LinearBound, LinearBound> PlaceBounds::mean_difference(const PlaceCell& cell,
                                                                 const PlanarBox& part) {
  return Side(*this, cell, true).mean(part);
}

FacingBound PlaceBounds::facing(const PlaceCell& cell, const PlanarBox& part) {
  return Side(*this, cell, true).facing(part);
}

}  // namespace stackabilization::detail
