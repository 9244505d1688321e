#include "rendering/scene/envelope_sheet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/surface_moments.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;  // in pixels of the window, heights in model units

struct SampleCount {
  int seen = 0, hidden = 0;
};

/// Cuts triangles where they pass behind others, according to the samples of a height field.
class SheetCutter {
 public:
  SheetCutter(const Shape& shape, const HeightField& field, EnvelopeSide side)
      : field_(field), side_(side), slack_(slack(shape, field.frame)) {}

  /// Appends the visible pieces of one triangle, in window coordinates.
  std::vector<Corners> cut(const Corners& triangle) const;

 private:
  static double slack(const Shape& shape, const Frame& frame);
  SampleCount count(const Corners& triangle) const;
  bool seen_near(const Corners& triangle) const;
  bool is_seen(int i, int j, double height, double tolerance) const;

  const HeightField& field_;
  EnvelopeSide side_;
  double slack_;  ///< heights this close to the envelope count as on it
};

/// Of the whole shape, walls too: what is seen may all lie at one height, and still carries rounding.
double SheetCutter::slack(const Shape& shape, const Frame& frame) {
  constexpr double fraction = 0.003;  // of the height: invisible in a picture, far above depth rounding
  const Range u = range_along(shape, frame.u), v = range_along(shape, frame.v),
              w = range_along(shape, frame.w);
  double farthest = 0;
  for (const Range& range : {u, v, w})
    farthest = std::max({farthest, std::abs(range.low), std::abs(range.high)});
  return std::max(fraction * w.length(), tolerance::relative * farthest);
}

bool SheetCutter::is_seen(int i, int j, double height, double tolerance) const {
  return side_ == EnvelopeSide::upper ? height >= field_.upper(i, j) - tolerance
                                      : height <= field_.lower(i, j) + tolerance;
}

SampleCount SheetCutter::count(const Corners& t) const {
  const Eigen::Vector2d a = t[0].head<2>(), ab = t[1].head<2>() - a, ac = t[2].head<2>() - a;
  const double area = ab.x() * ac.y() - ab.y() * ac.x();
  SampleCount result;
  if (area == 0) return result;
  const auto first = [](double low) { return std::max(0, static_cast<int>(std::ceil(low - 0.5))); };
  const auto last = [](double high, int limit) {
    return std::min(limit - 1, static_cast<int>(std::floor(high - 0.5)));
  };
  const auto [x0, x1] = std::minmax({t[0].x(), t[1].x(), t[2].x()});
  const auto [y0, y1] = std::minmax({t[0].y(), t[1].y(), t[2].y()});
  for (int i = first(x0); i <= last(x1, field_.window.columns); ++i)
    for (int j = first(y0); j <= last(y1, field_.window.rows); ++j) {
      const Eigen::Vector2d p = Eigen::Vector2d(i + 0.5, j + 0.5) - a;
      const double b = (p.x() * ac.y() - p.y() * ac.x()) / area, c = (ab.x() * p.y() - ab.y() * p.x()) / area;
      if (b < 0 || c < 0 || b + c > 1 || !field_.covered(i, j)) continue;
      const double height = (1 - b - c) * t[0].z() + b * t[1].z() + c * t[2].z();
      (is_seen(i, j, height, slack_) ? result.seen : result.hidden) += 1;
    }
  return result;
}

/// Returns whether a piece between samples is visible: compares its middle with the nearest sample, with an
/// allowance for its slope.
bool SheetCutter::seen_near(const Corners& t) const {
  constexpr double farthest = 0.71;  // pixels to the nearest sample
  const Eigen::Vector3d middle = (t[0] + t[1] + t[2]) / 3, normal = detail::area_vector(t[0], t[1], t[2]);
  if (normal.z() == 0) return false;
  const int i = std::clamp(static_cast<int>(middle.x()), 0, field_.window.columns - 1);
  const int j = std::clamp(static_cast<int>(middle.y()), 0, field_.window.rows - 1);
  const double slope = normal.head<2>().norm() / std::abs(normal.z());
  return field_.covered(i, j) && is_seen(i, j, middle.z(), slack_ + farthest * slope);
}

std::vector<Corners> SheetCutter::cut(const Corners& triangle) const {
  constexpr double finest = 1.5;  // pixels: longest edge of a piece that is not cut further
  std::vector<Corners> kept, open{triangle};
  while (!open.empty()) {
    const Corners t = open.back();
    open.pop_back();
    const SampleCount samples = count(t);
    const auto edge = [&](int k) {
      return (t[static_cast<std::size_t>((k + 1) % 3)] - t[static_cast<std::size_t>(k)]).head<2>().norm();
    };
    const int longest = edge(0) >= edge(1) && edge(0) >= edge(2) ? 0 : edge(1) >= edge(2) ? 1 : 2;
    if (samples.hidden == 0) {
      if (samples.seen > 0 || seen_near(t)) kept.push_back(t);
    } else if (samples.seen > 0 && edge(longest) > finest) {
      const auto a = static_cast<std::size_t>(longest), b = (a + 1) % 3, c = (a + 2) % 3;
      const Eigen::Vector3d middle = (t[a] + t[b]) / 2;
      open.push_back({t[a], middle, t[c]});
      open.push_back({middle, t[b], t[c]});
    } else if (samples.seen > samples.hidden) {
      kept.push_back(t);
    }
  }
  return kept;
}

/// Returns whether a triangle is so nearly parallel to r (about one degree) that the envelope jumps there.
bool is_wall(const Corners& t, double pixel_size) {
  constexpr double fraction = 0.02;
  const auto area = [](const Eigen::Vector3d& ab, const Eigen::Vector3d& ac) { return ab.cross(ac).norm(); };
  const auto scaled = [&](Eigen::Vector3d v, double height_factor) {
    return Eigen::Vector3d(v.x() * pixel_size, v.y() * pixel_size, v.z() * height_factor);
  };
  const Eigen::Vector3d ab = t[1] - t[0], ac = t[2] - t[0];
  return area(scaled(ab, 0), scaled(ac, 0)) <= fraction * area(scaled(ab, 1), scaled(ac, 1));
}

}  // namespace

Shape envelope_sheet(const Shape& shape, const HeightField& field, EnvelopeSide side) {
  const SheetCutter cutter(shape, field, side);
  const Window& window = field.window;
  std::vector<Eigen::Vector3d> corners;
  Shape sheet;
  sheet.part_names = shape.part_names;
  sheet.unit = shape.unit;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    Corners placed;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d q = field.frame.to_local(shape.corner(t, k));
      placed[static_cast<std::size_t>(k)] = {(q.x() - window.x) / window.pixel_size,
                                             (q.y() - window.y) / window.pixel_size, q.z()};
    }
    if (is_wall(placed, window.pixel_size)) continue;
    for (const Corners& piece : cutter.cut(placed)) {
      for (const Eigen::Vector3d& p : piece)
        corners.push_back(field.frame.to_world(
            {window.x + p.x() * window.pixel_size, window.y + p.y() * window.pixel_size, p.z()}));
      sheet.triangle_part.push_back(shape.triangle_part[static_cast<std::size_t>(t)]);
    }
  }
  sheet.vertices.resize(static_cast<Eigen::Index>(corners.size()), 3);
  sheet.triangles.resize(static_cast<Eigen::Index>(corners.size() / 3), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sheet.vertices.row(static_cast<Eigen::Index>(i)) = corners[i].transpose();
    sheet.triangles(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) =
        static_cast<std::int32_t>(i);
  }
  return sheet;
}

}  // namespace stackabilization
