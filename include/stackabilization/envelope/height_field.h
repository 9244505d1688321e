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

/// Upper and lower envelope of a shape sampled at pixel centres. Heights run along the unit vector w = r /
/// |r|. Exact at the samples up to double rounding when made by rays or scan conversion; single precision or
/// 24-bit depth when made by a graphics card. By rays or scan conversion, max over samples of u - l is a
/// lower bound of the exact closed f_max, up to rounding; a graphics card moves corners to a grid and gives
/// none. (The solid f_max ignores walls along r, a sample that falls on one does not.)
struct HeightField {
  Frame frame;                ///< w along r
  Window window;              ///< where the samples are
  Unit unit = Unit::unknown;  ///< of the shape
  Eigen::MatrixXd upper;      ///< columns x rows, heights along w, model units; -inf where no surface
  Eigen::MatrixXd lower;      ///< columns x rows; +inf where no surface

  /// Whether any surface was met at the sample of pixel (i, j).
  bool covered(int i, int j) const { return upper(i, j) >= lower(i, j); }
};

/// f = u - l (Eq. 1) per sample; NaN where nothing is covered. columns x rows, model units.
Eigen::MatrixXd gap(const HeightField& field);

/// Largest sampled gap, and where.
struct GapMaximum {
  double value = 0;           ///< model units
  int column = -1, row = -1;  ///< of its pixel
};
/// The maximum of `gap`, the first one in row order among equals; zero at (-1, -1) when nothing is covered.
GapMaximum maximum_gap(const HeightField& field);

/// Largest number of samples along a side of a window.
inline constexpr int max_resolution = 16384;

/// Window centred on the projection of the shape, `resolution` samples along its longer side, the other side
/// covered by whole pixels (at least one). Where the projection is a single point, the pixel is as large as
/// the extent along r. Throws UsageError unless 1 <= resolution <= max_resolution.
Window window_around(const Shape& shape, const Direction& direction, int resolution);

/// An empty height field (nothing covered) over `window`. Throws UsageError unless the window's numbers are
/// finite, its pixel size positive and both counts in [1, max_resolution].
HeightField empty_height_field(const Shape& shape, const Direction& direction, const Window& window);

/// Envelopes by ray casting through every sample: which triangles a ray meets is decided by exact predicates
/// on the ray whose end points are rounded to double; heights are constructed in double and never leave the
/// triangle's own range. Vertical triangles, met along a segment, count with both ends; triangles without
/// area cover nothing, and triangles with the same three points count once.
///
/// Built once per shape (CGAL AABB tree), queried for any number of directions and windows, also by several
/// threads at a time. A query runs in parallel over rows and is deterministic.
class RayCaster {
 public:
  /// Throws InputError unless `validate(shape)` passes.
  explicit RayCaster(const Shape& shape);
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;
  ~RayCaster();

  /// Throws UsageError as `empty_height_field` does, and InputError where all rays together meet more than
  /// `max_hits` triangles.
  HeightField cast(const Direction& direction, const Window& window,
                   std::int64_t max_hits = std::numeric_limits<std::int64_t>::max()) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// `RayCaster` for one use.
HeightField height_field_by_rays(const Shape& shape, const Direction& direction, const Window& window);

/// Envelopes by scan conversion of the projected triangles on the CPU, independent of the ray caster: heights
/// are interpolated in double along edges and then along rows, never extrapolated. Sample rule: pixel centre
/// inside or on the projected triangle, as rounded to double; neighbours that share an edge leave no crack
/// between them. Vertical triangles count with both ends. Parallel over bands of rows, deterministic. Throws
/// as `RayCaster` does.
HeightField height_field_by_scanline(const Shape& shape, const Direction& direction, const Window& window);

}  // namespace stackabilization
