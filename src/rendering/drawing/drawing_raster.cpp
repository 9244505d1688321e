#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/drawing.h"

namespace stackabilization {
namespace {

constexpr int dots_per_inch = 72;  // makes a font size in points one in pixels

vtkNew<vtkTextProperty> font(const Text& text) {
  vtkNew<vtkTextProperty> property;
  property->SetFontFamilyToArial();
  property->SetFontSize(static_cast<int>(std::lround(text.size)));
  property->SetBold(text.bold ? 1 : 0);
  property->SetColor(text.colour.red, text.colour.green, text.colour.blue);
  property->SetOrientation(text.upwards ? 90 : 0);
  property->SetVerticalJustificationToBottom();
  switch (text.anchor) {
    case Anchor::left:
      property->SetJustificationToLeft();
      break;
    case Anchor::centre:
      property->SetJustificationToCentered();
      break;
    case Anchor::right:
      property->SetJustificationToRight();
      break;
  }
  return property;
}

vtkTextRenderer& text_renderer() {
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (renderer == nullptr) throw RenderError("this build of VTK cannot draw text");
  return *renderer;
}

/// Pixels under construction. Coverage of polygons is exact along rows and sampled on eight lines per row
/// across them.
class Canvas {
 public:
  Canvas(int width, int height) : image_(width, height, palette::white) {}

  void draw(const FilledPolygon& polygon) { fill(polygon.points, polygon.colour); }
  void draw(const Polyline& line);
  void draw(const Text& text);
  void draw(const PlacedImage& placed);
  Image take() { return std::move(image_); }

 private:
  void fill(const PlanePoints& points, const Colour& colour);
  void add_spans(const PlanePoints& points, double y, std::vector<double>& coverage) const;
  void blend(int x, int y, const Colour& colour, double alpha);

  Image image_;
};

void Canvas::blend(int x, int y, const Colour& colour, double alpha) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height || alpha <= 0) return;
  const auto old = image_.pixel(x, y);
  image_.set_pixel(x, y, mix({old[0] / 255.0, old[1] / 255.0, old[2] / 255.0}, colour, std::min(alpha, 1.0)));
}

/// Adds the length of the polygon inside each pixel along the horizontal line at `y`.
void Canvas::add_spans(const PlanePoints& points, double y, std::vector<double>& coverage) const {
  std::vector<double> crossings;
  for (Eigen::Index k = 0; k < points.rows(); ++k) {
    const Eigen::RowVector2d a = points.row(k), b = points.row((k + 1) % points.rows());
    if ((a.y() <= y) != (b.y() <= y))
      crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    const double from = std::max(crossings[k], 0.0), to = std::min<double>(crossings[k + 1], image_.width);
    for (int x = static_cast<int>(from); x < to; ++x)
      coverage[static_cast<std::size_t>(x)] += std::min(to, x + 1.0) - std::max<double>(from, x);
  }
}

void Canvas::fill(const PlanePoints& points, const Colour& colour) {
  constexpr int lines = 8;
  if (points.rows() < 3 || !points.allFinite()) return;
  const int first = static_cast<int>(std::max(0.0, std::floor(points.col(1).minCoeff())));
  const int last =
      static_cast<int>(std::min<double>(image_.height - 1, std::floor(points.col(1).maxCoeff())));
  std::vector<double> coverage(static_cast<std::size_t>(image_.width));
  for (int row = first; row <= last; ++row) {
    std::fill(coverage.begin(), coverage.end(), 0.0);
    for (int line = 0; line < lines; ++line) add_spans(points, row + (line + 0.5) / lines, coverage);
    for (int x = 0; x < image_.width; ++x)
      blend(x, row, colour, coverage[static_cast<std::size_t>(x)] / lines);
  }
}

/// Each segment is a rectangle, lengthened by half the width at inner joints so that corners close.
void Canvas::draw(const Polyline& line) {
  const Eigen::Index last = line.points.rows() - 1;
  for (Eigen::Index k = 0; k < last; ++k) {
    const Eigen::RowVector2d a = line.points.row(k), b = line.points.row(k + 1);
    const double length = (b - a).norm();
    if (length <= 0) continue;
    const Eigen::RowVector2d along = (b - a) / length * line.width / 2, across(-along.y(), along.x());
    const Eigen::RowVector2d from = k > 0 ? a - along : a, to = k + 1 < last ? b + along : b;
    PlanePoints corners(4, 2);
    corners << from + across, to + across, to - across, from - across;
    fill(corners, line.colour);
  }
}

void Canvas::draw(const Text& text) {
  if (text.text.empty()) return;
  vtkNew<vtkImageData> glyphs;
  std::array<int, 2> size{};
  if (!text_renderer().RenderString(font(text), vtkStdString(text.text), glyphs, size.data(), dots_per_inch))
    throw RenderError("the text \"" + text.text + "\" could not be drawn");
  // VTK's line box reaches down to the descender of the font, 0.212 em below the base line.
  const int descent = static_cast<int>(std::ceil(0.212 * std::round(text.size)));
  const int x0 = static_cast<int>(std::lround(text.at.x())) + (text.upwards ? descent - 1 : 0);
  const int y0 = static_cast<int>(std::lround(text.at.y())) + (text.upwards ? 0 : descent);
  const int* extent = glyphs->GetExtent();
  for (int y = extent[2]; y <= extent[3]; ++y)
    for (int x = extent[0]; x <= extent[1]; ++x) {
      const auto* rgba = static_cast<const std::uint8_t*>(glyphs->GetScalarPointer(x, y, 0));
      blend(x0 + x, y0 - 1 - y, text.colour, rgba[3] / 255.0);
    }
}

/// Mean of the source pixels whose centres fall into a target pixel; the nearest one where there is none.
void Canvas::draw(const PlacedImage& placed) {
  const Image& source = placed.image;
  const Rectangle& place = placed.place;
  if (place.width <= 0 || place.height <= 0 || source.width == 0) return;
  const auto range = [](double from, double scale, int limit) {
    const int first = std::clamp(static_cast<int>(std::ceil(from * scale - 0.5)), 0, limit - 1);
    const int last = std::clamp(static_cast<int>(std::ceil((from + 1) * scale - 0.5)) - 1, 0, limit - 1);
    return first <= last ? std::array{first, last}
                         : std::array{std::clamp(static_cast<int>((from + 0.5) * scale), 0, limit - 1),
                                      std::clamp(static_cast<int>((from + 0.5) * scale), 0, limit - 1)};
  };
  const double scale_x = source.width / place.width, scale_y = source.height / place.height;
  const int left = static_cast<int>(std::lround(place.x)), top = static_cast<int>(std::lround(place.y));
  for (int y = 0; y < static_cast<int>(std::lround(place.height)); ++y)
    for (int x = 0; x < static_cast<int>(std::lround(place.width)); ++x) {
      const auto columns = range(x, scale_x, source.width), rows = range(y, scale_y, source.height);
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      for (int j = rows[0]; j <= rows[1]; ++j)
        for (int i = columns[0]; i <= columns[1]; ++i) {
          const auto value = source.pixel(i, j);
          sum += Eigen::Array3d(value[0], value[1], value[2]);
        }
      sum /= 255.0 * (columns[1] - columns[0] + 1) * (rows[1] - rows[0] + 1);
      blend(left + x, top + y, {sum[0], sum[1], sum[2]}, 1);
    }
}

}  // namespace

Image rasterize(const Drawing& drawing) {
  Canvas canvas(drawing.width, drawing.height);
  for (const auto& element : drawing.elements)
    std::visit([&](const auto& item) { canvas.draw(item); }, element);
  return canvas.take();
}

double text_width(const Text& text) {
  std::array<int, 4> box{};
  if (text.text.empty() ||
      !text_renderer().GetBoundingBox(font(text), vtkStdString(text.text), box.data(), dots_per_inch))
    return 0;
  return text.upwards ? box[3] - box[2] : box[1] - box[0];
}

}  // namespace stackabilization
