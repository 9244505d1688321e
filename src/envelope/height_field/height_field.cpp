#include "stackabilization/envelope/height_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "stackabilization/core/errors.h"

namespace stackabilization {

Eigen::MatrixXd gap(const HeightField& field) {
  const auto nothing = Eigen::MatrixXd::Constant(field.upper.rows(), field.upper.cols(),
                                                 std::numeric_limits<double>::quiet_NaN());
  return (field.upper.array() >= field.lower.array()).select(field.upper - field.lower, nothing);
}

GapMaximum maximum_gap(const HeightField& field) {
  GapMaximum best;
  for (int j = 0; j < field.upper.cols(); ++j)
    for (int i = 0; i < field.upper.rows(); ++i) {
      const double value = field.upper(i, j) - field.lower(i, j);
      if (field.covered(i, j) && (best.column < 0 || value > best.value)) best = {value, i, j};
    }
  return best;
}

namespace {

/// Bounds of the used vertices in frame coordinates.
struct LocalBounds {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
};

LocalBounds local_bounds(const Shape& shape, const Frame& frame) {
  LocalBounds bounds;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d local = frame.to_local(shape.corner(t, corner));
      bounds.low = bounds.low.cwiseMin(local);
      bounds.high = bounds.high.cwiseMax(local);
    }
  return bounds;
}

int pixels_over(double length, double pixel_size) {
  return std::clamp(static_cast<int>(std::ceil(length / pixel_size)), 1, max_resolution);
}

}  // namespace

Window window_around(const Shape& shape, const Direction& direction, int resolution) {
  validate(shape);
  if (resolution < 1 || resolution > max_resolution)
    throw UsageError("a resolution is a whole number from 1 to " + std::to_string(max_resolution) + ", not " +
                     std::to_string(resolution));
  const auto [low, high] = local_bounds(shape, frame_of(direction));
  const Eigen::Vector3d size = high - low;
  const double longer = std::max(size.x(), size.y());

  Window window;
  window.pixel_size = longer / resolution;
  window.columns = size.x() >= size.y() ? resolution : 0;
  window.rows = size.y() >= size.x() ? resolution : 0;
  if (window.pixel_size == 0) {
    window.pixel_size = size.z() > 0 ? size.z() : 1;
    window.columns = window.rows = 1;
  }
  if (window.columns == 0) window.columns = std::min(resolution, pixels_over(size.x(), window.pixel_size));
  if (window.rows == 0) window.rows = std::min(resolution, pixels_over(size.y(), window.pixel_size));
  window.x = (low.x() + high.x()) / 2 - window.pixel_size * window.columns / 2;
  window.y = (low.y() + high.y()) / 2 - window.pixel_size * window.rows / 2;
  return window;
}

HeightField empty_height_field(const Shape& shape, const Direction& direction, const Window& window) {
  if (!std::isfinite(window.x) || !std::isfinite(window.y) || !std::isfinite(window.pixel_size) ||
      window.pixel_size <= 0)
    throw UsageError("a sampling window needs a finite corner and a positive pixel size");
  if (std::min(window.columns, window.rows) < 1 || std::max(window.columns, window.rows) > max_resolution)
    throw UsageError("a sampling window needs 1 to " + std::to_string(max_resolution) +
                     " samples along each side");

  constexpr double nowhere = std::numeric_limits<double>::infinity();
  HeightField field;
  field.frame = frame_of(direction);
  field.window = window;
  field.unit = shape.unit;
  field.upper = Eigen::MatrixXd::Constant(window.columns, window.rows, -nowhere);
  field.lower = Eigen::MatrixXd::Constant(window.columns, window.rows, nowhere);
  return field;
}

}  // namespace stackabilization
