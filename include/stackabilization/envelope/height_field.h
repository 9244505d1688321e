#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Sampling window in the plane orthogonal to r: pixel (i, j) has its sample at
/// (x + (i + 1/2) pixel_size, y + (j + 1/2) pixel_size) in the frame's u, v coordinates.
struct Window {
  double x = 0, y = 0;        ///< lower left corner, model units, frame coordinates
  double pixel_size = 0;      ///< model units, > 0
  int columns = 0, rows = 0;  ///< pixels along u and along v

  /// Sample of pixel (i, j), frame coordinates.
  Eigen::Vector2d sample(int i, int j) const {
    return {x + (i + 0.5) * pixel_size, y + (j + 0.5) * pixel_size};
  }
};

/// Upper and lower envelope of a shape, sampled at pixel centres. Heights are measured along the unit vector
/// w = r / |r|.
///
/// Samples by rays or scan conversion are exact up to double rounding. The maximum of u - l over the samples
/// is then a lower bound of the exact closed f_max, up to rounding. Samples by a graphics card have single
/// precision or 24-bit depth; the card moves corners to a grid, so they give no bound. (The solid f_max
/// ignores walls along r; a sample on such a wall does not.)
struct HeightField {
  Frame frame;                ///< w along r
  Window window;              ///< positions of the samples
  Unit unit = Unit::unknown;  ///< unit of the shape
  Eigen::MatrixXd upper;      ///< columns x rows, heights along w, model units; -inf where no surface
  Eigen::MatrixXd lower;      ///< columns x rows; +inf where no surface

  /// Returns whether there is a surface at the sample of pixel (i, j).
  bool covered(int i, int j) const { return upper(i, j) >= lower(i, j); }
};

/// Computes f = u - l (Eq. 1) at every sample: columns x rows, model units, NaN where there is no surface.
Eigen::MatrixXd gap(const HeightField& field);

/// Largest sampled gap and its pixel.
struct GapMaximum {
  double value = 0;           ///< model units
  int column = -1, row = -1;  ///< pixel of the maximum
};
/// Returns the maximum of `gap`, the first one in row order among equals. The result is zero at (-1, -1) when
/// there is no surface at any sample.
GapMaximum maximum_gap(const HeightField& field);

/// Limit of the number of samples along a side of a window.
inline constexpr int max_resolution = 16384;

/// Returns a window centred on the projection of the shape. The longer side has `resolution` samples; the
/// other side has as many whole pixels as cover it, at least one. For a projection to a single point, the
/// pixel size is the extent along r. Throws UsageError unless 1 <= resolution <= max_resolution.
Window window_around(const Shape& shape, const Direction& direction, int resolution);

/// Returns a height field without any surface over `window`. Throws UsageError unless the numbers of the
/// window are finite, its pixel size is positive and both counts are in [1, max_resolution].
HeightField empty_height_field(const Shape& shape, const Direction& direction, const Window& window);

/// Envelopes by a ray through every sample. Exact predicates decide which triangles meet the ray, whose end
/// points are rounded to double. Heights are computed in double and stay within the range of the triangle.
/// Vertical triangles meet the ray along a segment and count with both ends. Triangles without area cover
/// nothing. Triangles with the same three points count once.
///
/// Built once per shape (CGAL AABB tree) and queried for any number of directions and windows, also by
/// several threads at a time. A query runs in parallel over rows and is deterministic.
class RayCaster {
 public:
  /// Throws InputError unless `validate(shape)` passes.
  explicit RayCaster(const Shape& shape);
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;
  ~RayCaster();

  /// Samples the envelopes. Throws UsageError as `empty_height_field` does. Throws InputError when all rays
  /// together meet more than `max_hits` triangles.
  HeightField cast(const Direction& direction, const Window& window,
                   std::int64_t max_hits = std::numeric_limits<std::int64_t>::max()) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// Runs a `RayCaster` once.
HeightField height_field_by_rays(const Shape& shape, const Direction& direction, const Window& window);

/// Computes envelopes by scan conversion of the projected triangles on the CPU, independently of the ray
/// caster. Heights are interpolated in double along edges and then along rows, and never extrapolated. A
/// triangle covers the pixel centres inside or on its projection, as rounded to double; neighbours with a
/// common edge leave no gap. Vertical triangles count with both ends. Parallel over bands of rows,
/// deterministic. Throws as `RayCaster` does.
HeightField height_field_by_scanline(const Shape& shape, const Direction& direction, const Window& window);

}  // namespace stackabilization
