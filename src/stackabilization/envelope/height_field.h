#pragma once

#include <Eigen/Core>

#include "stackabilization/shape/direction.h"
#include "stackabilization/shape/shape.h"

namespace stackabilization {

/// Sampling window in the plane orthogonal to r: pixel (i, j) has its sample at
/// (x + (i + 1/2) pixel_size, y + (j + 1/2) pixel_size) in the frame's u, v coordinates.
struct Window {
  double x = 0, y = 0;    ///< lower left corner, model units, frame coordinates
  double pixel_size = 0;  ///< model units, > 0
  int columns = 0, rows = 0;
};

/// Upper and lower envelope of a shape sampled at pixel centres. Exact at its samples up to double rounding
/// when made by rays; single precision or 24-bit depth when made by a graphics card. Whatever made it, max
/// over samples of u - l never exceeds the exact f_max by more than that precision: sampling is a lower
/// bound.
struct HeightField {
  Frame frame;  ///< w along r
  Window window;
  Unit unit = Unit::unknown;
  Eigen::MatrixXd upper;  ///< columns x rows, heights along w, model units; -inf where no surface
  Eigen::MatrixXd lower;  ///< columns x rows; +inf where no surface

  bool covered(int i, int j) const { return upper(i, j) >= lower(i, j); }
};

/// f = u - l (Eq. 1) per sample; NaN where nothing is covered. columns x rows.
Eigen::MatrixXd gap(const HeightField& field);

/// Largest sampled gap with its pixel. Zero at (-1, -1) when nothing is covered.
struct GapMaximum {
  double value = 0;
  int column = -1, row = -1;
};
GapMaximum maximum_gap(const HeightField& field);

/// Square window around the projection of the shape, `resolution` samples along its longer side, the other
/// side covered by whole pixels. Throws UsageError unless 1 <= resolution <= 16384.
Window window_around(const Shape& shape, const Direction& direction, int resolution);

/// Envelopes by exact-predicate ray casting (CGAL AABB tree) through every sample; heights constructed in
/// double. Vertical triangles that a ray meets along a segment count with both ends.
HeightField height_field_by_rays(const Shape& shape, const Direction& direction, const Window& window);

/// Envelopes by scan conversion of the projected triangles on the CPU: heights interpolated in double, sample
/// rule: pixel centre inside or on the projected triangle.
HeightField height_field_by_scanline(const Shape& shape, const Direction& direction, const Window& window);

}  // namespace stackabilization
