#include "stackabilization/rendering/depth_raster.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCullerCollection.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rendering/gl/offscreen_window.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {
namespace {

// Heights fill the middle 7/8 of the depth range, so that nothing is clipped and depth 1 means "nothing
// here"; with this fraction and a camera at distance 2 every entry of the projection in depth is exact in
// single precision.
constexpr double used_depth = 7.0 / 8.0;
constexpr double depth_steps = 16777215;  // 2^24 - 1

Points in_frame(const Points& points, const Frame& frame) {
  Points local(points.rows(), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    local.row(i) = frame.to_local(points.row(i).transpose()).transpose();
  return local;
}

/// Part of a window that is rendered at once.
struct Tile {
  int column, row, columns, rows;
};

/// Range of heights, and the linear map of the depth buffer onto it.
struct HeightRange {
  double low, high;

  double middle() const { return low / 2 + high / 2; }
  double half() const { return high / 2 - low / 2; }
  /// Height of window depth `depth` in a picture from above (side = 1) or from below (side = -1).
  double height(float depth, double side) const {
    const double stored = std::round(static_cast<double>(depth) * depth_steps) / depth_steps;
    return std::clamp(middle() + side * (1 - 2 * stored) / used_depth * half(), low, high);
  }
};

}  // namespace

struct DepthRasterizer::Data {
  Shape shape;
  int tile_size;
  detail::OffscreenWindow window;
  vtkNew<vtkFloatArray> coordinates;
  vtkNew<vtkPoints> points;
  vtkNew<vtkPolyData> mesh;
  vtkNew<vtkOpenGLPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkFloatArray> depth;

  Data(const Shape& input, const DepthRasterOptions& options);
  void place(const Points& local, const HeightRange& range, const Window& target, const Tile& tile);
  void draw(const Tile& tile, double side);
};

DepthRasterizer::Data::Data(const Shape& input, const DepthRasterOptions& options)
    : shape(input), tile_size(options.tile_size), window(1, 1) {
  if (tile_size < 1) throw UsageError("the tile size of a depth raster must be at least 1 pixel");
  validate(shape);
  tile_size = std::min(tile_size, window.maximal_side());

  vtkNew<vtkTypeInt32Array> corners;
  corners->SetNumberOfValues(shape.triangles.size());
  std::copy_n(shape.triangles.data(), shape.triangles.size(), corners->GetPointer(0));
  vtkNew<vtkCellArray> cells;
  cells->SetData(3, corners);
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(shape.vertex_count());
  points->SetData(coordinates);
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  mapper->SetInputData(mesh);
  mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
  renderer->GetCullers()->RemoveAllItems();
  renderer->SetBackground(0, 0, 0);
  window.vtk().AddRenderer(renderer);
  window.vtk().SetMultiSamples(0);

  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetPosition(0, 0, 2);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetViewUp(0, 1, 0);
  camera->SetClippingRange(1, 3);
}

/// Converts the triangles to pixels relative to the middle of the tile, and heights to [-7/8, 7/8]. Vertices
/// that no triangle uses may have any values.
void DepthRasterizer::Data::place(const Points& local, const HeightRange& range, const Window& target,
                                  const Tile& tile) {
  const double x = tile.column + tile.columns / 2.0, y = tile.row + tile.rows / 2.0;
  const double scale = range.half() > 0 ? used_depth / range.half() : 0;
  float* out = coordinates->GetPointer(0);
  for (Eigen::Index i = 0; i < local.rows(); ++i, out += 3) {
    out[0] = static_cast<float>((local(i, 0) - target.x) / target.pixel_size - x);
    out[1] = static_cast<float>((local(i, 1) - target.y) / target.pixel_size - y);
    out[2] = static_cast<float>((local(i, 2) - range.middle()) * scale);
    if (!std::isfinite(out[0]) || !std::isfinite(out[1]) || !std::isfinite(out[2])) std::fill_n(out, 3, 0.0F);
  }
  coordinates->Modified();
  points->Modified();
  mesh->Modified();
}

/// The view from below is the view from above after mirroring the heights, which keeps the pixels and their
/// tie rule.
void DepthRasterizer::Data::draw(const Tile& tile, double side) {
  actor->SetScale(1, 1, side);
  renderer->GetActiveCamera()->SetParallelScale(tile.rows / 2.0);
  window.render();
  window.vtk().GetZbufferData(0, 0, tile.columns - 1, tile.rows - 1, depth);
}

DepthRasterizer::DepthRasterizer(const Shape& shape, const DepthRasterOptions& options)
    : data_(std::make_unique<Data>(shape, options)) {}
DepthRasterizer::DepthRasterizer(DepthRasterizer&&) noexcept = default;
DepthRasterizer& DepthRasterizer::operator=(DepthRasterizer&&) noexcept = default;
DepthRasterizer::~DepthRasterizer() = default;

HeightField DepthRasterizer::height_field(const Direction& direction, const Window& window) {
  HeightField field = empty_height_field(data_->shape, direction, window);
  const Points local = in_frame(data_->shape.vertices, field.frame);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  HeightRange range{infinity, -infinity};
  for (const std::int32_t vertex : data_->shape.triangles.reshaped<Eigen::RowMajor>()) {
    range.low = std::min(range.low, local(vertex, 2));
    range.high = std::max(range.high, local(vertex, 2));
  }
  const auto read_back = [&](const Tile& tile, double side, Eigen::MatrixXd& heights) {
    data_->draw(tile, side);
    const float* depth = data_->depth->GetPointer(0);
    for (int j = 0; j < tile.rows; ++j)
      for (int i = 0; i < tile.columns; ++i, ++depth)
        if (*depth < 1) heights(tile.column + i, tile.row + j) = range.height(*depth, side);
  };
  for (int row = 0; row < window.rows; row += data_->tile_size)
    for (int column = 0; column < window.columns; column += data_->tile_size) {
      const Tile tile{column, row, std::min(data_->tile_size, window.columns - column),
                      std::min(data_->tile_size, window.rows - row)};
      data_->window.resize(tile.columns, tile.rows);
      data_->place(local, range, window, tile);
      read_back(tile, 1, field.upper);
      read_back(tile, -1, field.lower);
    }
  return field;
}

HeightField height_field_by_depth_buffer(const Shape& shape, const Direction& direction, const Window& window,
                                         const DepthRasterOptions& options) {
  return DepthRasterizer(shape, options).height_field(direction, window);
}

Window authors_window(const Shape& shape, const Direction& direction) {
  constexpr int pixels = 200;
  validate(shape);
  const Points local = in_frame(shape.vertices, frame_of(direction));
  Eigen::Vector3d low = local.row(shape.triangles(0, 0)).transpose(), high = low;
  for (const std::int32_t vertex : shape.triangles.reshaped<Eigen::RowMajor>()) {
    low = low.cwiseMin(local.row(vertex).transpose());
    high = high.cwiseMax(local.row(vertex).transpose());
  }
  const Eigen::Vector3d extent = high - low, centre = low / 2 + high / 2;
  const double width = std::max({1.5 * extent.x(), 1.5 * extent.y(), 3 * extent.z()});
  if (width <= 0)
    throw InputError("a sampling window needs a shape with an extent, and this one is a single point");
  return {centre.x() - width / 2, centre.y() - width / 2, width / pixels, pixels, pixels};
}

}  // namespace stackabilization
