#include "generator/modelling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "generator/skin.h"

namespace stackabilization::models {

namespace {

/// The points with every piece cut evenly so that none is longer than `step`.
template <typename Point>
std::vector<Point> refined(const std::vector<Point>& points, double step) {
  std::vector<Point> result = {points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point from = points[i - 1], to = points[i];
    // Lengths that are whole multiples of the step up to rounding must not depend on the rounding.
    const int pieces = std::max(1, static_cast<int>(std::ceil((to - from).norm() / step - 0.01)));
    for (int k = 1; k <= pieces; ++k) result.push_back(from + (to - from) * k / pieces);
  }
  return result;
}

std::vector<Ring> rings_of(const Curve& profile, const Outline& outline) {
  std::vector<Ring> rings;
  for (const Eigen::Vector2d& knot : profile) {
    Ring ring;
    for (const Eigen::Vector2d& p : outline(knot.x())) ring.emplace_back(p.x(), p.y(), knot.y());
    rings.push_back(ring);
  }
  return rings;
}

/// Where the edge around an end face runs, for an edge of size 1: (inset, advance) from the end face to the
/// flank.
using Edge = std::vector<Eigen::Vector2d>;
const Edge chamfered = {{1, 0}, {0, 1}};
const Edge rounded = {{1, 0}, {0.293, 0.293}, {0, 1}};

}  // namespace

Curve profile(const std::vector<Knot>& knots, double step) {
  Curve points;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const Eigen::Vector2d p(knots[i].distance, knots[i].height);
    if (knots[i].reach == 0 || i == 0 || i + 1 == knots.size()) {
      points.push_back(p);
      continue;
    }
    const Eigen::Vector2d before(knots[i - 1].distance, knots[i - 1].height);
    const Eigen::Vector2d after(knots[i + 1].distance, knots[i + 1].height);
    const double reach = std::min({knots[i].reach, 0.45 * (before - p).norm(), 0.45 * (after - p).norm()});
    const Eigen::Vector2d a = p + reach * (before - p).normalized();
    const Eigen::Vector2d b = p + reach * (after - p).normalized();
    const int pieces = reach < 0.006 ? 2 : 3;
    for (int k = 0; k <= pieces; ++k) {
      const double s = static_cast<double>(k) / pieces;
      points.push_back((1 - s) * (1 - s) * a + 2 * s * (1 - s) * p + s * s * b);
    }
  }
  return refined(points, step);
}

Outline circle(int segments) {
  return ellipse(segments, 1);
}

Outline ellipse(int segments, double y_factor) {
  return [=](double radius) {
    Curve curve;
    for (int k = 0; k < segments; ++k) {
      const double angle = 2 * std::numbers::pi * k / segments;
      curve.emplace_back(radius * std::cos(angle), radius * y_factor * std::sin(angle));
    }
    return curve;
  };
}

Outline rounded_rectangle(const Rectangle& rectangle) {
  return [=](double offset) {
    const double radius = rectangle.radius + offset;
    const Eigen::Vector2d core(rectangle.width / 2 - rectangle.radius,
                               rectangle.depth / 2 - rectangle.radius);
    Curve corners;
    for (int quadrant = 0; quadrant < 4; ++quadrant)
      for (int k = 0; k < rectangle.corner_points; ++k) {
        const double angle =
            std::numbers::pi / 2 * (quadrant + static_cast<double>(k) / (rectangle.corner_points - 1));
        const Eigen::Vector2d hub(quadrant % 3 == 0 ? core.x() : -core.x(),
                                  quadrant < 2 ? core.y() : -core.y());
        corners.push_back(hub + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      }
    Curve curve;
    const auto count = static_cast<int>(corners.size());
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d from = corners[static_cast<std::size_t>(i)];
      const Eigen::Vector2d to = corners[static_cast<std::size_t>((i + 1) % count)];
      const bool side = (i + 1) % rectangle.corner_points == 0;
      const bool along_x = (i + 1) / rectangle.corner_points % 2 == 1;
      const int pieces = !side ? 1 : along_x ? rectangle.pieces_x : rectangle.pieces_y;
      for (int k = 0; k < pieces; ++k) curve.push_back(from + (to - from) * k / pieces);
    }
    return curve;
  };
}

Shape loft(const std::vector<Ring>& rings, int cap_rings) {
  Skin skin(rings);
  for (std::size_t i = 1; i < rings.size(); ++i) skin.join(i - 1, i);
  skin.cap(0, cap_rings, Skin::End::first);
  skin.cap(rings.size() - 1, cap_rings, Skin::End::last);
  return skin.shape();
}

Shape lathe(const Curve& profile, const Outline& outline, int cap_rings) {
  return loft(rings_of(profile, outline), cap_rings);
}

Shape hoop(const Curve& profile, const Outline& outline) {
  Skin skin(rings_of(profile, outline));
  for (std::size_t i = 0; i < profile.size(); ++i) skin.join(i, (i + 1) % profile.size());
  return skin.shape();
}

Shape slab(const Slab& slab, const Outline& outline) {
  Curve edge;
  for (const Eigen::Vector2d& p : rounded)
    edge.emplace_back(-slab.edge * p.x(), slab.bottom + slab.edge * p.y());
  for (auto p = rounded.rbegin(); p != rounded.rend(); ++p)
    edge.emplace_back(-slab.edge * p->x(), slab.top - slab.edge * p->y());
  return lathe(edge, outline, slab.cap_rings);
}

Shape bar(const Bar& bar) {
  const Path path = refined(bar.path, bar.step);
  std::vector<double> arc = {0};
  for (std::size_t i = 1; i < path.size(); ++i) arc.push_back(arc.back() + (path[i] - path[i - 1]).norm());
  const auto pieces = [&](double first, double last) {
    return std::max(
        1, static_cast<int>(std::ceil((1 - bar.roundness) * std::max(first, last) / bar.step - 0.01)));
  };
  const auto ring_at = [&](std::size_t i, const Eigen::Vector2d& end, double sign) {
    const std::size_t last = path.size() - 1;
    const Eigen::Vector3d along = (path[std::min(i + 1, last)] - path[i == 0 ? 0 : i - 1]).normalized();
    const Eigen::Vector3d side = (bar.side - along * along.dot(bar.side)).normalized(),
                          across = along.cross(side);
    const double s = arc[i] / arc.back();
    const double width = (1 - s) * bar.first.width + s * bar.last.width;
    const double depth = (1 - s) * bar.first.depth + s * bar.last.depth;
    const Outline outline = rounded_rectangle({.width = width,
                                               .depth = depth,
                                               .radius = bar.roundness * std::min(width, depth) / 2,
                                               .corner_points = bar.corner_points,
                                               .pieces_x = pieces(bar.first.width, bar.last.width),
                                               .pieces_y = pieces(bar.first.depth, bar.last.depth)});
    Ring ring;
    for (const Eigen::Vector2d& p : outline(-bar.edge * end.x()))
      ring.push_back(path[i] + sign * bar.edge * end.y() * along + p.x() * side + p.y() * across);
    return ring;
  };
  std::vector<Ring> rings;
  for (const Eigen::Vector2d& end : chamfered) rings.push_back(ring_at(0, end, 1));
  for (std::size_t i = 1; i + 1 < path.size(); ++i) rings.push_back(ring_at(i, {0, 0}, 0));
  for (auto end = chamfered.rbegin(); end != chamfered.rend(); ++end)
    rings.push_back(ring_at(path.size() - 1, *end, -1));
  return loft(rings, 0);
}

Shape rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector2d& diameters,
          int segments) {
  const Eigen::Vector3d along = (b - a).normalized();
  const Eigen::Vector3d side =
      std::abs(along.z()) > 0.5 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d u = (side - along * along.dot(side)).normalized(), v = along.cross(u);
  const double length = (b - a).norm(), edge = 0.1 * diameters.minCoeff();
  Curve flank;
  for (const Eigen::Vector2d& p : chamfered)
    flank.emplace_back(diameters[0] / 2 - edge * p.x(), edge * p.y());
  for (auto p = chamfered.rbegin(); p != chamfered.rend(); ++p)
    flank.emplace_back(diameters[1] / 2 - edge * p->x(), length - edge * p->y());
  return moved(lathe(refined(flank, 0.065), circle(segments), 0), [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(a + p.x() * u + p.y() * v + p.z() * along);
  });
}

Path bezier(const Eigen::Matrix<double, 4, 3>& control, int pieces) {
  Path path;
  for (int k = 0; k <= pieces; ++k) {
    const double s = static_cast<double>(k) / pieces, t = 1 - s;
    path.push_back(
        (Eigen::RowVector4d(t * t * t, 3 * t * t * s, 3 * t * s * s, s * s * s) * control).transpose());
  }
  return path;
}

Shape levelled(Shape shape) {
  shape.vertices.col(2) = shape.vertices.col(2).cwiseMax(0);
  return shape;
}

Shape joined(const std::vector<Shape>& pieces) {
  Shape shape = pieces.front();
  for (std::size_t i = 1; i < pieces.size(); ++i) shape = concatenate(shape, pieces[i]);
  return make_shape(shape.vertices, shape.triangles);
}

Shape moved(Shape shape, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& place) {
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    shape.vertices.row(v) = place(shape.vertices.row(v));
  return shape;
}

Shape shifted(Shape shape, const Eigen::Vector3d& by) {
  shape.vertices.rowwise() += by.transpose();
  return shape;
}

Shape turned(Shape shape, double degrees) {
  const Eigen::AngleAxisd rotation(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitZ());
  return transformed(shape, rotation.toRotationMatrix(), Eigen::Vector3d::Zero());
}

void Assembly::add(const std::string& name, Shape part) {
  part.part_names = {name};
  shape_ = shape_.triangle_count() == 0 ? std::move(part) : concatenate(shape_, part);
}

void Assembly::add_pair(const std::string& name, const Shape& part) {
  Shape mirrored = part;
  mirrored.vertices.col(0) *= -1;
  mirrored.triangles.col(1).swap(mirrored.triangles.col(2));
  add(name + "_left", std::move(mirrored));
  add(name + "_right", part);
}

Shape Assembly::finished() const {
  // Design dimensions halved a few times end in exact half micrometres; the bias moves the ties of rounding
  // to where no coordinate lies, so that the last bit of sin or of a fused multiply-add cannot change the
  // file.
  constexpr double per_metre = 1e6, bias = 0.00317;
  Shape shape = shape_;
  shape.unit = Unit::metre;
  shape.vertices.col(2).array() -= shape.vertices.col(2).minCoeff();
  shape.vertices = shape.vertices.unaryExpr([](double x) {
    const double micrometres = std::floor(std::abs(x) * per_metre + 0.5 + bias);
    return micrometres == 0 ? 0.0 : std::copysign(micrometres / per_metre, x);
  });
  return shape;
}

}  // namespace stackabilization::models
