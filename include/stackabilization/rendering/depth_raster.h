#pragma once

#include <memory>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/height_field.h"

namespace stackabilization {

/// How windows are cut for the graphics card.
struct DepthRasterOptions {
  /// Largest side rendered at once, pixels; the driver's own limit applies too. Larger windows are drawn in
  /// tiles.
  int tile_size = 2048;
};

/// Envelopes read from an OpenGL depth buffer, the paper's own method (section 3): an orthographic picture
/// from above along -r and one from below, one sample per pixel centre, no multisampling.
///
/// Heights carry the 24-bit depth: steps of (8/7) h(M, r) 2^-24, plus the card's single precision in
/// interpolating steep triangles. Coverage follows the card's pixel-centre rule, in which corners are snapped
/// to 1/256 pixel: triangles so steep that they span little more than that get heights beyond their own, so
/// the largest gap is no lower bound of f_max. Triangles exactly parallel to r have no pixels. Needs no
/// display. Throws RenderError when there is no OpenGL context, UsageError for a window that
/// `empty_height_field` refuses or a tile size below 1, and InputError when the shape is not valid.
HeightField height_field_by_depth_buffer(const Shape& shape, const Direction& direction, const Window& window,
                                         const DepthRasterOptions& options = {});

/// The same for many directions: the OpenGL context and the triangles are kept. Use from one thread at a
/// time.
class DepthRasterizer {
 public:
  /// Throws as `height_field_by_depth_buffer`.
  explicit DepthRasterizer(const Shape& shape, const DepthRasterOptions& options = {});
  DepthRasterizer(DepthRasterizer&&) noexcept;
  DepthRasterizer& operator=(DepthRasterizer&&) noexcept;
  ~DepthRasterizer();

  /// As `height_field_by_depth_buffer`.
  HeightField height_field(const Direction& direction, const Window& window);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// The framing of the authors' program: 200 x 200 pixels around the centre of the box in the frame of r, with
/// the visible width max(1.5 ex, 1.5 ey, 3 ez) for the box extents ex, ey, ez in that frame. Throws
/// InputError when the shape is a point.
Window authors_window(const Shape& shape, const Direction& direction);

}  // namespace stackabilization
