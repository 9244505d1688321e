#include "support/solids.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "support/variants.h"

namespace stackabilization::solids {

namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Is p inside or on the counter-clockwise triangle a b c?
bool covers(const std::array<Eigen::Vector2d, 3>& triangle, const Eigen::Vector2d& p) {
  for (std::size_t i = 0; i < 3; ++i)
    if (cross(triangle[(i + 1) % 3] - triangle[i], p - triangle[i]) < 0) return false;
  return true;
}

/// Collects the corners and triangles of one part.
class Builder {
 public:
  std::int32_t add(const Eigen::Vector3d& point) {
    points_.push_back(point);
    return static_cast<std::int32_t>(points_.size()) - 1;
  }
  /// A triangle that has a corner twice is left out: that is how rings shrink to a point of the axis.
  void triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
    if (a != b && b != c && c != a) triangles_.push_back({a, b, c});
  }
  void quad(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  Shape shape() const {
    Points points(static_cast<Eigen::Index>(points_.size()), 3);
    Triangles triangles(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (std::size_t i = 0; i < points_.size(); ++i) points.row(static_cast<Eigen::Index>(i)) = points_[i];
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      for (int k = 0; k < 3; ++k)
        triangles(static_cast<Eigen::Index>(i), k) = triangles_[i][static_cast<std::size_t>(k)];
    return make_shape(std::move(points), std::move(triangles));
  }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
};

/// Sweeps a profile in (rho, z) around the outline: ring corner = (rho * outline, z).
Shape swept_around(const Polygon& profile, const Polygon& outline) {
  const std::size_t n = outline.size();
  Builder builder;
  std::vector<std::vector<std::int32_t>> rings;
  for (const Eigen::Vector2d& p : profile) {
    std::vector<std::int32_t> ring(n);
    for (std::size_t k = 0; k < n; ++k)
      ring[k] = p.x() == 0 && k > 0 ? ring[0]
                                    : builder.add({p.x() * outline[k].x(), p.x() * outline[k].y(), p.y()});
    rings.push_back(ring);
  }
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const std::vector<std::int32_t>&from = rings[i], &to = rings[(i + 1) % profile.size()];
    for (std::size_t k = 0; k < n; ++k) builder.quad(from[k], from[(k + 1) % n], to[(k + 1) % n], to[k]);
  }
  return builder.shape();
}

/// Corners low[i] and high[i] of a prism, polygon counter-clockwise seen from the high side.
Shape between(const std::vector<Eigen::Vector3d>& low, const std::vector<Eigen::Vector3d>& high,
              const Triangles& cap) {
  Builder builder;
  for (const Eigen::Vector3d& p : low) builder.add(p);
  for (const Eigen::Vector3d& p : high) builder.add(p);
  const auto n = static_cast<std::int32_t>(low.size());
  for (std::int32_t i = 0; i < n; ++i) builder.quad(i, (i + 1) % n, n + (i + 1) % n, n + i);
  for (Eigen::Index t = 0; t < cap.rows(); ++t) {
    builder.triangle(cap(t, 0), cap(t, 2), cap(t, 1));
    builder.triangle(n + cap(t, 0), n + cap(t, 1), n + cap(t, 2));
  }
  return builder.shape();
}

}  // namespace

Eigen::Vector2d circle_point(int k, int n) {
  const int turned = ((k % n) + n) % n;
  const int quarter = 4 * turned / n, rest = 4 * turned % n;
  const double angle = std::numbers::pi / 2 * rest / n;
  const Eigen::Vector2d p =
      rest == 0 ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(std::cos(angle), std::sin(angle));
  switch (quarter) {
    case 0:
      return p;
    case 1:
      return {-p.y(), p.x()};
    case 2:
      return -p;
    default:
      return {p.y(), -p.x()};
  }
}

Polygon regular_polygon(int n) {
  Polygon polygon;
  for (int k = 0; k < n; ++k) polygon.push_back(circle_point(k, n));
  return polygon;
}

Triangles triangulate(const Polygon& polygon) {
  std::vector<std::size_t> left(polygon.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  Triangles triangles(static_cast<Eigen::Index>(polygon.size()) - 2, 3);
  const auto is_ear = [&](std::size_t i) {
    const std::size_t a = left[(i + left.size() - 1) % left.size()], b = left[i],
                      c = left[(i + 1) % left.size()];
    const std::array<Eigen::Vector2d, 3> ear = {polygon[a], polygon[b], polygon[c]};
    if (cross(ear[1] - ear[0], ear[2] - ear[0]) <= 0) return false;
    return std::none_of(left.begin(), left.end(),
                        [&](std::size_t j) { return j != a && j != b && j != c && covers(ear, polygon[j]); });
  };
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::size_t i = 0;
    while (i < left.size() && !is_ear(i)) ++i;
    if (i == left.size()) throw std::invalid_argument("the polygon is not simple and counter-clockwise");
    const std::size_t before = left[(i + left.size() - 1) % left.size()], after = left[(i + 1) % left.size()];
    triangles.row(t) << static_cast<std::int32_t>(before), static_cast<std::int32_t>(left[i]),
        static_cast<std::int32_t>(after);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return triangles;
}

Shape prism(const Polygon& polygon, double height) {
  std::vector<Eigen::Vector3d> low, high;
  for (const Eigen::Vector2d& p : polygon) {
    low.emplace_back(p.x(), p.y(), 0);
    high.emplace_back(p.x(), p.y(), height);
  }
  return between(low, high, triangulate(polygon));
}

Shape extruded_profile(const Polygon& polygon, double width) {
  std::vector<Eigen::Vector3d> back, front;
  for (const Eigen::Vector2d& p : polygon) {
    back.emplace_back(p.x(), width, p.y());
    front.emplace_back(p.x(), 0, p.y());
  }
  return between(back, front, triangulate(polygon));
}

Shape box(const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest) {
  std::vector<Eigen::Vector3d> low, high;
  const std::array<Eigen::Vector3d, 2> corners = {lowest, highest};
  for (const auto& [i, j] : std::array<std::array<std::size_t, 2>, 4>{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}) {
    low.emplace_back(corners[i].x(), corners[j].y(), lowest.z());
    high.emplace_back(corners[i].x(), corners[j].y(), highest.z());
  }
  return between(low, high, (Triangles(2, 3) << 0, 1, 2, 0, 2, 3).finished());
}

Shape open_box(const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest) {
  Shape shape = box(lowest, highest);
  shape.triangles.conservativeResize(shape.triangle_count() - 2, 3);
  shape.triangle_part.resize(static_cast<std::size_t>(shape.triangle_count()));
  return shape;
}

double box_f_max(const Eigen::Vector3d& size, const Direction& direction) {
  double f = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (direction.vector()[axis] != 0) f = std::min(f, size[axis] / std::abs(direction.vector()[axis]));
  return f;
}

Shape boxes_sharing_wall() {
  return concatenate(named(box({0, 0, 0}, {1, 1, 1}), "low"), named(box({1, 0, 2}, {2, 1, 3}), "high"));
}

Shape tetrahedron(const std::array<Eigen::Vector3d, 4>& corners) {
  Builder builder;
  for (const Eigen::Vector3d& corner : corners) builder.add(corner);
  builder.triangle(0, 2, 1);
  builder.triangle(0, 1, 3);
  builder.triangle(1, 2, 3);
  builder.triangle(2, 0, 3);
  const Shape shape = builder.shape();
  return signed_volume(shape) > 0 ? shape : flipped(shape);
}

double tetrahedron_f_max(const std::array<Eigen::Vector3d, 4>& corners, const Direction& direction) {
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = corners[static_cast<std::size_t>(i) + 1] - corners[0];
  const Eigen::Vector3d b = edges.inverse() * direction.vector();
  return 1 / (b.cwiseMax(0).sum() + std::max(0.0, -b.sum()));
}

Shape surface_of_revolution(const Polygon& profile, int segments) {
  return swept_around(profile, regular_polygon(segments));
}

Shape cylinder(double radius, double height, int segments) {
  return surface_of_revolution({{0, 0}, {radius, 0}, {radius, height}, {0, height}}, segments);
}

Shape frustum_shell(const FrustumShell& cup) {
  return surface_of_revolution({{0, 0},
                                {cup.outer_bottom, 0},
                                {cup.outer_top, cup.height},
                                {cup.inner_top, cup.height},
                                {cup.inner_bottom, cup.floor},
                                {0, cup.floor}},
                               cup.segments);
}

double frustum_shell_f_max(const FrustumShell& cup) {
  const auto ramp = [](double rho, double from, double to) {
    if (rho <= from) return 0.0;
    return rho >= to ? 1.0 : (rho - from) / (to - from);
  };
  const double over_foot =
      cup.floor + (cup.height - cup.floor) * ramp(cup.outer_bottom, cup.inner_bottom, cup.inner_top);
  const double under_rim = cup.height * (1 - ramp(cup.inner_top, cup.outer_bottom, cup.outer_top));
  return std::max(over_foot, under_rim);
}

Shape stairs(const Stairs& options) {
  Polygon profile = {{options.count * options.tread, 0}};
  for (int i = options.count; i > 0; --i) {
    profile.emplace_back(i * options.tread, i * options.rise);
    profile.emplace_back((i - 1) * options.tread, i * options.rise);
  }
  profile.emplace_back(0, 0);
  return extruded_profile(profile, options.width);
}

Shape stair_plate(const Stairs& options) {
  const double a = options.tread, b = options.rise, t = options.thickness;
  Polygon profile = {{0, 0}, {t, 0}, {t, b - t}};
  for (int i = 1; i < options.count; ++i) {
    profile.emplace_back(i * a + t, i * b - t);
    profile.emplace_back(i * a + t, (i + 1) * b - t);
  }
  profile.emplace_back(options.count * a, options.count * b - t);
  for (int i = options.count; i > 0; --i) {
    profile.emplace_back(i * a, i * b);
    profile.emplace_back((i - 1) * a, i * b);
  }
  return extruded_profile(profile, options.width);
}

double stair_plate_f_max(const Stairs& options) {
  return options.rise + options.thickness;
}

Shape l_shape(double size, double thickness) {
  const double s = size, t = thickness;
  return extruded_profile({{0, 0}, {s, 0}, {s, t}, {t, t}, {t, s}, {0, s}}, 1);
}

double l_shape_f_max(double size, double thickness, const Direction& direction) {
  const Eigen::Vector3d& r = direction.vector();
  if (r.y() != 0) throw std::invalid_argument("closed form for directions in the plane of the L only");
  if (r.x() == 0) return size / std::abs(r.z());
  if (r.z() == 0) return size / std::abs(r.x());
  if (r.x() == r.z()) return thickness / std::abs(r.x());
  throw std::invalid_argument("closed form along x, z and (1, 0, 1) only");
}

Shape u_shape(double size, double thickness) {
  const double s = size, t = thickness;
  return extruded_profile({{0, 0}, {s, 0}, {s, s}, {s - t, s}, {s - t, t}, {t, t}, {t, s}, {0, s}}, 1);
}

Shape hook(const Hook& options) {
  const double l = options.length, h = options.height, t = options.thickness;
  const Shape low = box({0, 0, 0}, {l, 1, t}), high = box({0, 0, h - t}, {l, 1, h});
  const Shape ramp =
      moved(extruded_profile({{0, h - t}, {l, 0}, {l, t}, {0, h}}, 1), Eigen::Vector3d::UnitY());
  return concatenate(concatenate(named(low, "low_bar"), named(ramp, "ramp")), named(high, "high_bar"));
}

Shape wine_glass(int segments) {
  return surface_of_revolution({{0, 0},
                                {4, 0},
                                {4, 0.25},
                                {0.5, 0.5},
                                {0.5, 6.5},
                                {4.75, 9},
                                {3.5, 13},
                                {3.25, 13},
                                {4.25, 9},
                                {0, 7}},
                               segments);
}

Shape torus(const Torus& options) {
  Polygon profile;
  for (const Eigen::Vector2d& p : regular_polygon(options.tube_segments))
    profile.emplace_back(options.ring_radius + options.tube_radius * p.x(), options.tube_radius * p.y());
  return surface_of_revolution(profile, options.ring_segments);
}

Shape bumpy_bowl(int cells) {
  const int corners = cells + 1;
  Points points(corners * corners, 3);
  Triangles triangles(2 * cells * cells, 3);
  for (int i = 0; i < corners; ++i)
    for (int j = 0; j < corners; ++j) {
      const double x = -1 + 2.0 * i / cells, y = -1 + 2.0 * j / cells;
      points.row(i * corners + j) << x, y, 0.6 * (x * x + y * y) + 0.02 * std::sin(40 * x) * std::cos(37 * y);
    }
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const int a = i * corners + j, b = a + corners;
      triangles.row(2 * (i * cells + j)) << a, b, b + 1;
      triangles.row(2 * (i * cells + j) + 1) << a, b + 1, a + 1;
    }
  return make_shape(points, triangles);
}

Shape sphere(double radius, int levels) {
  const double g = std::numbers::phi;
  Points points(12, 3);
  points << 0, 1, g, 0, -1, g, 0, 1, -g, 0, -1, -g, 1, g, 0, -1, g, 0, 1, -g, 0, -1, -g, 0, g, 0, 1, g, 0, -1,
      -g, 0, 1, -g, 0, -1;
  Triangles faces(20, 3);
  faces << 0, 1, 8, 0, 8, 4, 0, 4, 5, 0, 5, 10, 0, 10, 1, 1, 6, 8, 8, 6, 9, 8, 9, 4, 4, 9, 2, 4, 2, 5, 5, 2,
      11, 5, 11, 10, 10, 11, 7, 10, 7, 1, 1, 7, 6, 3, 9, 6, 3, 2, 9, 3, 11, 2, 3, 7, 11, 3, 6, 7;
  Shape shape = make_shape(points, faces);
  for (int level = 0; level < levels; ++level) {
    shape.vertices.rowwise().normalize();
    shape = subdivided(shape);
  }
  shape.vertices.rowwise().normalize();
  shape.vertices *= radius;
  return shape;
}

Shape table(const Table& options) {
  const double w = options.width, under = options.height - options.top, l = options.leg;
  Shape shape = named(box({0, 0, under}, {w, w, options.height}), "top");
  int number = 0;
  for (const auto& [x, y] :
       std::array<std::array<double, 2>, 4>{{{0, 0}, {w - l, 0}, {w - l, w - l}, {0, w - l}}})
    shape =
        concatenate(shape, named(box({x, y, 0}, {x + l, y + l, under}), "leg_" + std::to_string(++number)));
  return shape;
}

Shape gridfinity_bin(const GridfinityBin& options) {
  const double pitch = 7.0 * options.units, half = 20.75, opening = half - 2.6, wall = half - 0.95;
  const double narrow = opening - options.seat, support = pitch - 1.2;
  Polygon profile = {{0, 0},
                     {17.8, 0},
                     {18.6, 0.8},
                     {18.6, 2.6},
                     {half, 4.75},
                     {half, pitch + 4.4},
                     {opening + 0.7, pitch + 2.5},
                     {opening + 0.7, pitch + 0.7},
                     {opening, pitch}};
  if (options.seat > 0) profile.emplace_back(narrow, pitch);
  profile.insert(profile.end(), {{narrow, support}, {wall, support - (wall - narrow)}, {wall, 7}, {0, 7}});
  Shape shape = swept_around(profile, {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}});
  shape.unit = Unit::millimetre;
  return shape;
}

double gridfinity_bin_f_max(const GridfinityBin& options) {
  return 7.0 * options.units - (options.seat > 0 ? 0 : 0.35);
}

}  // namespace stackabilization::solids
