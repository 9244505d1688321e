#pragma once

#include <memory>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/height_field.h"

namespace stackabilization {

/// Options of `height_field_by_depth_buffer`.
struct DepthRasterOptions {
  /// Largest side that is rendered at once, pixels; the limit of the driver applies too. Larger windows are
  /// rendered in tiles.
  int tile_size = 2048;
};

/// Reads the envelopes from an OpenGL depth buffer, the method of the paper (section 3): an orthographic
/// picture from above along -r and one from below, with one sample per pixel centre and no multisampling.
///
/// Heights have 24-bit depth, in steps of (8/7) h(M, r) 2^-24, plus the error of the card's single precision
/// in the interpolation of steep triangles. Coverage follows the card's pixel-centre rule with corners
/// snapped to 1/256 pixel. Triangles so steep that their projection is not much wider than that get heights
/// beyond their own, so the largest gap is not a lower bound of f_max. Triangles exactly parallel to r have
/// no pixels. Needs no display. Throws RenderError when there is no OpenGL context, UsageError for a window
/// that `empty_height_field` refuses or a tile size below 1, and InputError when the shape is not valid.
HeightField height_field_by_depth_buffer(const Shape& shape, const Direction& direction, const Window& window,
                                         const DepthRasterOptions& options = {});

/// Depth-buffer sampling in many directions. It keeps the OpenGL context and the triangles. Use it from one
/// thread at a time.
class DepthRasterizer {
 public:
  /// Throws as `height_field_by_depth_buffer` does.
  explicit DepthRasterizer(const Shape& shape, const DepthRasterOptions& options = {});
  DepthRasterizer(DepthRasterizer&&) noexcept;
  DepthRasterizer& operator=(DepthRasterizer&&) noexcept;
  ~DepthRasterizer();

  /// Samples the envelopes as `height_field_by_depth_buffer` does.
  HeightField height_field(const Direction& direction, const Window& window);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// Returns the window of the authors' program: 200 x 200 pixels around the centre of the box in the frame of
/// r. Its width is max(1.5 ex, 1.5 ey, 3 ez) for the box extents ex, ey, ez in that frame. Throws InputError
/// when the shape is a point.
Window authors_window(const Shape& shape, const Direction& direction);

}  // namespace stackabilization
