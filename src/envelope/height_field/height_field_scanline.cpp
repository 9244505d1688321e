#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "stackabilization/envelope/height_field.h"

namespace stackabilization {

namespace {

using LocalTriangle = std::array<Eigen::Vector3d, 3>;

/// A point of a row's vertical plane: position along the row and height.
struct RowPoint {
  double x, z;
  bool operator<(const RowPoint& other) const { return std::tie(x, z) < std::tie(other.x, other.z); }
};

/// Samples of one coordinate of a window.
class SampleLine {
 public:
  SampleLine(double origin, double step, int count) : origin_(origin), step_(step), count_(count) {}

  double operator[](int i) const { return origin_ + (i + 0.5) * step_; }

  /// First sample at or after `value`; the count when there is none.
  int first_from(double value) const {
    int i =
        static_cast<int>(std::clamp(std::floor((value - origin_) / step_), 0.0, static_cast<double>(count_)));
    while (i > 0 && (*this)[i - 1] >= value) --i;
    while (i < count_ && (*this)[i] < value) ++i;
    return i;
  }

 private:
  double origin_, step_;
  int count_;
};

/// Writes the triangles' heights into a band of rows of a height field.
class Scanner {
 public:
  Scanner(HeightField& field, int first_row, int end_row)
      : field_(field),
        first_row_(first_row),
        end_row_(end_row),
        x_(field.window.x, field.window.pixel_size, field.window.columns),
        y_(field.window.y, field.window.pixel_size, field.window.rows) {}

  void draw(const LocalTriangle& corners) {
    const auto [low, high] = std::minmax({corners[0].y(), corners[1].y(), corners[2].y()});
    if (y_[first_row_] > high || y_[end_row_ - 1] < low) return;
    for (int j = std::max(first_row_, y_.first_from(low)); j < end_row_ && y_[j] <= high; ++j) {
      if (low == high)
        draw_outline(corners, j);
      else
        draw_slice(corners, j);
    }
  }

 private:
  /// The triangle lies in the plane of the row: its edges bound the column over every sample.
  void draw_outline(const LocalTriangle& corners, int j) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d &a = corners[k], &b = corners[(k + 1) % 3];
      draw_segment(std::minmax(RowPoint{a.x(), a.z()}, RowPoint{b.x(), b.z()}), j);
    }
  }

  /// The triangle crosses the plane of the row in a segment.
  void draw_slice(const LocalTriangle& corners, int j) {
    std::array<RowPoint, 6> points;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d *a = &corners[k], *b = &corners[(k + 1) % 3];
      // One order for both triangles of an edge, so that they get the very same crossing.
      if (std::make_tuple(b->y(), b->x(), b->z()) < std::make_tuple(a->y(), a->x(), a->z())) std::swap(a, b);
      if (y_[j] < a->y() || y_[j] > b->y()) continue;
      if (a->y() == b->y()) {
        points[count++] = {a->x(), a->z()};
        points[count++] = {b->x(), b->z()};
      } else {
        const double t = (y_[j] - a->y()) / (b->y() - a->y());
        points[count++] = {std::lerp(a->x(), b->x(), t), std::lerp(a->z(), b->z(), t)};
      }
    }
    const auto [left, right] = std::minmax_element(points.begin(), points.begin() + count);
    draw_segment({*left, *right}, j);
  }

  void draw_segment(const std::pair<RowPoint, RowPoint>& segment, int j) {
    const auto [left, right] = segment;
    const auto [low, high] = std::minmax(left.z, right.z);
    for (int i = x_.first_from(left.x); i < field_.window.columns && x_[i] <= right.x; ++i) {
      if (left.x == right.x) {
        raise(i, j, low, high);
      } else {
        const double z = left.z + (right.z - left.z) * ((x_[i] - left.x) / (right.x - left.x));
        raise(i, j, std::clamp(z, low, high), std::clamp(z, low, high));
      }
    }
  }

  void raise(int i, int j, double low, double high) {
    field_.lower(i, j) = std::min(field_.lower(i, j), low);
    field_.upper(i, j) = std::max(field_.upper(i, j), high);
  }

  HeightField& field_;
  int first_row_, end_row_;
  SampleLine x_, y_;
};

}  // namespace

HeightField height_field_by_scanline(const Shape& shape, const Direction& direction, const Window& window) {
  validate(shape);
  HeightField field = empty_height_field(shape, direction, window);
  std::vector<LocalTriangle> triangles(static_cast<std::size_t>(shape.triangle_count()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      triangles[t][static_cast<std::size_t>(corner)] =
          field.frame.to_local(shape.corner(static_cast<Eigen::Index>(t), corner));

  // Bands write to rows of their own; few and wide, because each looks at every triangle.
  const int band = std::max(32, window.rows / 16);
  tbb::parallel_for(tbb::blocked_range<int>(0, window.rows, static_cast<std::size_t>(band)),
                    [&](const tbb::blocked_range<int>& rows) {
                      Scanner scanner(field, rows.begin(), rows.end());
                      for (const LocalTriangle& triangle : triangles) scanner.draw(triangle);
                    });
  return field;
}

}  // namespace stackabilization
