#include "envelope/height_bounds/height_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/index.h"
#include "envelope/separation/shear.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {
namespace {

/// Nodes with no more faces are not split: their faces are examined one by one.
constexpr std::size_t leaf_faces = 8;
constexpr std::int32_t max_depth = 24;
/// Levels below a node that may show that it is covered where its own faces do not.
constexpr int levels_below = 3;
/// Nodes narrower than this fraction of a rectangle count as a whole in it.
constexpr double fine = 0.25;

PlanarBox common(const PlanarBox& a, const PlanarBox& b) {
  return {std::max(a.x_low, b.x_low), std::min(a.x_high, b.x_high), std::max(a.y_low, b.y_low),
          std::min(a.y_high, b.y_high)};
}

/// The smallest and the largest of the signed areas that the line from p along (dx, dy) spans with the
/// corners.
std::pair<double, double> sides(double px, double py, double dx, double dy, const PlanarBox& box) {
  const double middle = dx * ((box.y_low + box.y_high) / 2 - py) - dy * ((box.x_low + box.x_high) / 2 - px);
  const double spread = std::abs(dx) * box.height() / 2 + std::abs(dy) * box.width() / 2;
  return {middle - spread, middle + spread};
}

}  // namespace

HeightBounds::HeightBounds(ProjectedMesh mesh) : error_(mesh.error) {
  const Eigen::Vector2d low = mesh.points.leftCols<2>().colwise().minCoeff();
  const Eigen::Vector2d high = mesh.points.leftCols<2>().colwise().maxCoeff();
  size_ = std::max({std::abs(low.x()), std::abs(low.y()), std::abs(high.x()), std::abs(high.y())});
  cross_error_ = 4 * error_ + 16 * unit_roundoff * size_;
  make_faces(mesh);
  make_patches(mesh);
  open_components(mesh);
  Node root;
  root.box = {low.x() - error_, high.x() + error_, low.y() - error_, high.y() + error_};
  for (std::size_t f = 0; f < faces_.size(); ++f) root.faces.push_back(static_cast<std::int32_t>(f));
  for (std::size_t b = 0; b < borders_.size(); ++b) root.borders.push_back(static_cast<std::int32_t>(b));
  nodes_.push_back(std::move(root));
}

void HeightBounds::make_faces(const ProjectedMesh& mesh) {
  faces_.resize(static_cast<std::size_t>(mesh.triangles->rows()));
  for (Eigen::Index t = 0; t < mesh.triangles->rows(); ++t) {
    Face& face = faces_[static_cast<std::size_t>(t)];
    std::array<double, 3> h;
    for (int c = 0; c < 3; ++c) {
      const auto point = mesh.points.row((*mesh.triangles)(t, c));
      face.x[at(c)] = point.x();
      face.y[at(c)] = point.y();
      h[at(c)] = point.z();
    }
    double ax = face.x[1] - face.x[0], ay = face.y[1] - face.y[0];
    double bx = face.x[2] - face.x[0], by = face.y[2] - face.y[0];
    double area = ax * by - ay * bx;
    face.side = area < 0 ? Side::from_below : Side::from_above;
    if (area < 0) {
      std::swap(face.x[1], face.x[2]);
      std::swap(face.y[1], face.y[2]);
      std::swap(h[1], h[2]);
      std::swap(ax, bx);
      std::swap(ay, by);
      area = -area;
    }
    face.h_low = std::min({h[0], h[1], h[2]});
    face.h_high = std::max({h[0], h[1], h[2]});
    const double length = std::max(
        {std::abs(ax) + std::abs(ay), std::abs(bx) + std::abs(by), std::abs(bx - ax) + std::abs(by - ay)});
    const double area_error = length * cross_error_;
    face.patch = area > area_error ? 0 : -1;
    face.thickness = face.patch < 0 ? area + area_error : 0;
    face.base_height = h[0];
    face.slope_x = ((h[1] - h[0]) * by - (h[2] - h[0]) * ay) / area;
    face.slope_y = ((h[2] - h[0]) * ax - (h[1] - h[0]) * bx) / area;
    // Slopes carry the errors of the coordinates, relative to the height of the triangle, and are used within
    // its box.
    const double quotient = length * length / area;
    face.plane_error =
        16 * (face.h_high - face.h_low) * quotient * (4 * unit_roundoff + 4 * error_ / length) * quotient +
        8 * unit_roundoff * std::max(std::abs(face.h_low), std::abs(face.h_high));
    if (face.patch < 0 || !std::isfinite(face.plane_error)) {
      face.slope_x = face.slope_y = 0;
      face.plane_error = infinity;
    }
  }
}

void HeightBounds::make_patches(const ProjectedMesh& mesh) {
  const EdgeTable& edges = *mesh.edges;
  DisjointSets sets(faces_.size());
  /// Returns how many more triangles lie on the left of the edge than on the right.
  const auto surplus = [&](std::size_t e) {
    int left = 0;
    for (const TriangleSide& side : edges[e]) {
      if (faces_[at(side.triangle)].patch < 0) continue;
      const auto corner = [&](int c) { return mesh.points.row((*mesh.triangles)(side.triangle, c % 3)); };
      const auto a = corner(0), b = corner(1), c = corner(2);
      const bool counter_clockwise =
          (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()) > 0;
      left += counter_clockwise == side.forward ? 1 : -1;
    }
    return left;
  };
  std::vector<std::size_t> border_edges;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (surplus(e) != 0) {
      border_edges.push_back(e);
      continue;
    }
    std::int32_t first = -1;
    for (const TriangleSide& side : edges[e]) {
      if (faces_[at(side.triangle)].patch < 0) continue;
      if (first >= 0) sets.join(at(first), at(side.triangle));
      first = side.triangle;
    }
  }
  for (std::size_t f = 0; f < faces_.size(); ++f)
    if (faces_[f].patch >= 0) faces_[f].patch = static_cast<std::int32_t>(sets.root(f));
  patches_.resize(faces_.size());
  for (const std::size_t e : border_edges)
    for (const TriangleSide& side : edges[e]) {
      const std::int32_t patch = faces_[at(side.triangle)].patch;
      if (patch < 0) continue;
      const auto p = mesh.points.row(side.low), q = mesh.points.row(side.high);
      borders_.push_back({{p.x(), q.x()}, {p.y(), q.y()}, patch});
    }
}

/// Marks the triangles of components that are not closed.
void HeightBounds::open_components(const ProjectedMesh& mesh) {
  const EdgeTable& edges = *mesh.edges;
  DisjointSets components(faces_.size());
  std::vector<std::int32_t> open_at;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    int surplus = 0;
    for (const TriangleSide& side : edges[e]) {
      components.join(at(edges[e].front().triangle), at(side.triangle));
      surplus += side.forward ? 1 : -1;
    }
    if (surplus != 0) open_at.push_back(edges[e].front().triangle);
  }
  std::vector<bool> is_open(faces_.size(), false);
  for (const std::int32_t triangle : open_at) is_open[components.root(at(triangle))] = true;
  for (std::size_t f = 0; f < faces_.size(); ++f)
    if (is_open[components.root(f)]) faces_[f].side = Side::open;
}

HeightBound HeightBounds::over(const PlanarBox& rectangle, const Eigen::Vector2d& slope) {
  if (!rectangle.meets(box())) return {};
  HeightBound bound = over(0, rectangle, slope);
  if (!box().contains(rectangle)) bound.low = -infinity;
  return bound;
}

Range HeightBounds::covered_area(int rectangles) {
  Range area{0, 0};
  std::queue<PlanarBox> open;
  open.push(box());
  for (; !open.empty(); open.pop()) {
    const PlanarBox& next = open.front();
    const HeightBound bound = over(next);
    if (!bound.possibly_covered()) continue;
    const bool certain = bound.certainly_covered();
    if (certain) area.low += next.width() * next.height();
    if (certain || --rectangles < 0)
      area.high += next.width() * next.height();
    else
      for (const PlanarBox& quarter : next.quarters()) open.push(quarter);
  }
  return {area.low * (1 - tolerance::relative), area.high * (1 + tolerance::relative)};
}

HeightBound HeightBounds::over(std::int32_t index, const PlanarBox& rectangle, const Eigen::Vector2d& slope) {
  const PlanarBox box = nodes_[at(index)].box;
  if (nodes_[at(index)].faces.size() <= leaf_faces && (!slope.isZero(0) || !rectangle.contains(box)))
    return direct(nodes_[at(index)], common(box, rectangle), slope);
  if (rectangle.contains(box) || nodes_[at(index)].depth == max_depth ||
      std::max(box.width(), box.height()) < fine * std::max(rectangle.width(), rectangle.height()))
    return sheared(whole(index, levels_below), box, slope);
  split(index);
  const std::int32_t first = nodes_[at(index)].first_child;
  HeightBound bound{infinity, -infinity};
  for (std::int32_t child = first; child < first + 4; ++child) {
    if (!rectangle.meets(nodes_[at(child)].box)) continue;
    const HeightBound part = over(child, rectangle, slope);
    bound = {std::min(bound.low, part.low), std::max(bound.high, part.high),
             std::min(bound.covered_low, part.covered_low)};
  }
  return bound;
}

/// Bounds of u - slope . p from those of u over a box.
HeightBound HeightBounds::sheared(const HeightBound& bound, const PlanarBox& box,
                                  const Eigen::Vector2d& slope) const {
  const double steepness = std::abs(slope.x()) + std::abs(slope.y());
  const double middle = slope.x() * (box.x_low + box.x_high) / 2 + slope.y() * (box.y_low + box.y_high) / 2;
  const double spread = (std::abs(slope.x()) * box.width() + std::abs(slope.y()) * box.height()) / 2 +
                        8 * unit_roundoff * size_ * steepness;
  return {bound.low - middle - spread, bound.high - middle + spread, bound.covered_low - middle - spread};
}

Eigen::Vector2d HeightBounds::slope_at(double x, double y) const {
  const PlanarBox point{x, x, y, y};
  if (!box().contains(point)) return Eigen::Vector2d::Zero();
  const Node* node = &nodes_.front();
  while (node->first_child >= 0) {
    const bool right = x > node->box.x_low / 2 + node->box.x_high / 2;
    const bool back = y > node->box.y_low / 2 + node->box.y_high / 2;
    node = &nodes_[at(node->first_child + (right ? 1 : 0) + (back ? 2 : 0))];
  }
  if (node->faces.size() > leaf_faces) return Eigen::Vector2d::Zero();
  double highest = -infinity;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  for (const std::int32_t f : node->faces) {
    const Face& face = faces_[at(f)];
    if (face.plane_error == infinity || overlap(face, point) == Overlap::none) continue;
    const double height = face.base_height + face.slope_x * (x - face.x[0]) + face.slope_y * (y - face.y[0]);
    if (height <= highest) continue;
    highest = height;
    slope = {face.slope_x, face.slope_y};
  }
  return slope;
}

HeightBound HeightBounds::whole(std::int32_t index, int levels) {
  if (!nodes_[at(index)].known) {
    nodes_[at(index)].bound = direct(nodes_[at(index)], nodes_[at(index)].box, Eigen::Vector2d::Zero());
    nodes_[at(index)].known = true;
    const Node& node = nodes_[at(index)];
    if (node.bound.low == -infinity && node.faces.size() > leaf_faces && levels > 0 &&
        node.depth < max_depth) {
      split(index);
      const std::int32_t first = nodes_[at(index)].first_child;
      double low = infinity;
      for (std::int32_t child = first; child < first + 4 && low > -infinity; ++child)
        low = std::min(low, whole(child, levels - 1).low);
      nodes_[at(index)].bound.low = low;
    }
  }
  return nodes_[at(index)].bound;
}

HeightBound HeightBounds::direct(const Node& node, const PlanarBox& rectangle, const Eigen::Vector2d& slope) {
  ++call_;
  HeightBound result;
  const auto state = [this](std::int32_t patch) -> PatchState& {
    PatchState& known = patches_[at(patch)];
    if (known.call != call_) known = {call_, infinity, false, false};
    return known;
  };
  for (const std::int32_t b : node.borders) {
    const Border& border = borders_[at(b)];
    if (meets(border, rectangle)) state(border.patch).bordered = true;
  }
  std::array<double, 3> low_of_side;
  low_of_side.fill(infinity);
  for (const std::int32_t f : node.faces) {
    const Face& face = faces_[at(f)];
    const Overlap met = overlap(face, rectangle);
    if (met == Overlap::none) continue;
    const HeightBound bound = plane_bound(face, rectangle, slope);
    result.high = std::max(result.high, bound.high);
    if (face.patch < 0) continue;
    double& low = low_of_side[static_cast<std::size_t>(face.side)];
    low = std::min(low, bound.low);
    PatchState& patch = state(face.patch);
    patch.low = std::min(patch.low, bound.low);
    patch.touched = patch.touched || met == Overlap::certain;
  }
  for (const std::int32_t f : node.faces) {
    if (faces_[at(f)].patch < 0) continue;
    const PatchState& patch = patches_[at(faces_[at(f)].patch)];
    if (patch.call == call_ && patch.touched && !patch.bordered) result.low = std::max(result.low, patch.low);
  }
  // A point that a closed component covers is covered from both sides.
  const auto& [above, below, open] = low_of_side;
  const double closed = above == infinity || below == infinity ? infinity : std::max(above, below);
  result.covered_low = std::max(result.low, std::min(closed, open));
  return result;
}

void HeightBounds::split(std::int32_t index) {
  if (nodes_[at(index)].first_child >= 0) return;
  const auto first = static_cast<std::int32_t>(nodes_.size());
  for (const PlanarBox& quarter : nodes_[at(index)].box.quarters()) {
    Node child;
    child.box = quarter;
    child.depth = nodes_[at(index)].depth + 1;
    for (const std::int32_t f : nodes_[at(index)].faces)
      if (overlap(faces_[at(f)], quarter) != Overlap::none) child.faces.push_back(f);
    for (const std::int32_t b : nodes_[at(index)].borders)
      if (meets(borders_[at(b)], quarter)) child.borders.push_back(b);
    nodes_.push_back(std::move(child));
  }
  nodes_[at(index)].first_child = first;
}

HeightBounds::Overlap HeightBounds::overlap(const Face& face, const PlanarBox& box) const {
  const auto [x_low, x_high] = std::minmax({face.x[0], face.x[1], face.x[2]});
  const auto [y_low, y_high] = std::minmax({face.y[0], face.y[1], face.y[2]});
  if (x_low > box.x_high + error_ || box.x_low > x_high + error_ || y_low > box.y_high + error_ ||
      box.y_low > y_high + error_)
    return Overlap::none;
  bool certain = face.patch >= 0 && x_low < box.x_high - error_ && box.x_low < x_high - error_ &&
                 y_low < box.y_high - error_ && box.y_low < y_high - error_;
  for (int e = 0; e < 3; ++e) {
    const std::size_t p = at(e), q = at((e + 1) % 3);
    const double dx = face.x[q] - face.x[p], dy = face.y[q] - face.y[p];
    const double margin = (std::abs(dx) + std::abs(dy)) * cross_error_;
    const auto [low, high] = sides(face.x[p], face.y[p], dx, dy, box);
    if (high < -margin - face.thickness) return Overlap::none;
    if (face.patch < 0 && low > margin + face.thickness) return Overlap::none;
    certain = certain && high > margin;
  }
  return certain ? Overlap::certain : Overlap::possible;
}

bool HeightBounds::meets(const Border& border, const PlanarBox& box) const {
  if (std::min(border.x[0], border.x[1]) > box.x_high + error_ ||
      box.x_low > std::max(border.x[0], border.x[1]) + error_ ||
      std::min(border.y[0], border.y[1]) > box.y_high + error_ ||
      box.y_low > std::max(border.y[0], border.y[1]) + error_)
    return false;
  const double dx = border.x[1] - border.x[0], dy = border.y[1] - border.y[0];
  const double margin = (std::abs(dx) + std::abs(dy)) * cross_error_;
  const auto [low, high] = sides(border.x[0], border.y[0], dx, dy, box);
  return low <= margin && high >= -margin;
}

/// Of the part of a face over the box.
HeightBound HeightBounds::plane_bound(const Face& face, const PlanarBox& box,
                                      const Eigen::Vector2d& slope) const {
  const auto [x_low, x_high] = std::minmax({face.x[0], face.x[1], face.x[2]});
  const auto [y_low, y_high] = std::minmax({face.y[0], face.y[1], face.y[2]});
  PlanarBox part = common(box, {x_low - error_, x_high + error_, y_low - error_, y_high + error_});
  const HeightBound range = sheared({face.h_low, face.h_high, face.h_low}, part, slope);
  if (face.plane_error == infinity) return range;
  const double x = (part.x_low + part.x_high) / 2, y = (part.y_low + part.y_high) / 2;
  const double middle = face.base_height + face.slope_x * (x - face.x[0]) + face.slope_y * (y - face.y[0]) -
                        slope.x() * x - slope.y() * y;
  const double spread = std::abs(face.slope_x - slope.x()) * part.width() / 2 +
                        std::abs(face.slope_y - slope.y()) * part.height() / 2 + face.plane_error +
                        8 * unit_roundoff * size_ * (std::abs(slope.x()) + std::abs(slope.y()));
  return {std::max(range.low, middle - spread), std::min(range.high, middle + spread),
          std::max(range.low, middle - spread)};
}

}  // namespace stackabilization::detail
