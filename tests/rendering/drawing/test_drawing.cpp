#include <cmath>
#include <filesystem>
#include <string>

#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/drawing.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

/// Ink on white: the sum over pixels of how dark they are, in pixels.
double darkness(const Image& image) {
  double sum = 0;
  for (const std::uint8_t value : image.bytes) sum += 255 - value;
  return sum / (3 * 255);
}

PlanePoints polygon(std::initializer_list<std::array<double, 2>> corners) {
  PlanePoints points(static_cast<Eigen::Index>(corners.size()), 2);
  Eigen::Index k = 0;
  for (const auto& [x, y] : corners) points.row(k++) << x, y;
  return points;
}

constexpr Colour black{0, 0, 0};

Image drawn(DrawingElement element) {
  Drawing drawing{40, 30, {}};
  drawing.add(std::move(element));
  return rasterize(drawing);
}

}  // namespace

TEST_CASE("a polygon darkens by its area") {
  CHECK(darkness(drawn(FilledPolygon{polygon({{3.25, 4.5}, {10.5, 4.5}, {10.5, 9}, {3.25, 9}}), black})) ==
        Approx(7.25 * 4.5).epsilon(0.01));
  CHECK(darkness(drawn(FilledPolygon{polygon({{2, 3}, {35, 8}, {11, 27}}), black})) ==
        Approx(0.5 * (33 * 24 - 5 * 9)).epsilon(0.01));
  CHECK(darkness(drawn(FilledPolygon{polygon({{-100, -100}, {100, -100}, {100, 100}, {-100, 100}}),
                                     black})) == Approx(40 * 30));
  CHECK(darkness(drawn(FilledPolygon{polygon({{2, 3}, {35, 8}}), black})) == 0);
}

TEST_CASE("a polyline darkens by its length times its width") {
  CHECK(darkness(drawn(Polyline{polygon({{5, 5}, {33, 20}}), black, 3})) ==
        Approx(3 * std::hypot(28, 15)).epsilon(0.02));
  // Overlap at the joint: a square of the line's width, drawn twice.
  CHECK(darkness(drawn(Polyline{polygon({{5, 5}, {25, 5}, {25, 25}}), black, 2})) ==
        Approx(2 * 40).epsilon(0.02));
}

TEST_CASE("text stands on its base line beside its anchor") {
  const auto ink_bounds = [](const Image& image) {
    std::array<int, 4> bounds{image.width, -1, image.height, -1};
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        if (image.pixel(x, y)[0] < 128)
          bounds = {std::min(bounds[0], x), std::max(bounds[1], x), std::min(bounds[2], y),
                    std::max(bounds[3], y)};
    return bounds;
  };
  Drawing drawing{200, 100, {}};
  drawing.add(Text{{100, 60}, "HHH", 20, black});
  const auto left = ink_bounds(rasterize(drawing));
  CHECK(left[0] >= 100);
  CHECK(left[1] <= 100 + text_width({{0, 0}, "HHH", 20}));
  CHECK(std::abs(left[3] - 59) <= 1);                      // base line
  CHECK(left[3] - left[2] + 1 == Approx(14.5).margin(2));  // height of a capital
  drawing.elements = {Text{{100, 60}, "HHH", 20, black, Anchor::right}};
  CHECK(ink_bounds(rasterize(drawing))[1] <= 100);
  drawing.elements = {Text{{100, 60}, "HHH", 20, black, Anchor::left, false, true}};
  const auto upwards = ink_bounds(rasterize(drawing));
  CHECK(std::abs(upwards[1] - 99) <= 1);
  CHECK(upwards[3] <= 60);
  CHECK(upwards[2] >= 60 - text_width({{0, 0}, "HHH", 20}) - 1);
}

TEST_CASE("images keep sharp cells when enlarged and are averaged when shrunk") {
  Image checks(2, 2, palette::white);
  checks.set_pixel(0, 0, black);
  checks.set_pixel(1, 1, black);
  const Image enlarged = drawn(PlacedImage{{10, 5, 20, 20}, checks, Sampling::cells});
  CHECK(enlarged.pixel(19, 14)[0] == 0);
  CHECK(enlarged.pixel(20, 14)[0] == 255);
  CHECK(enlarged.pixel(20, 15)[0] == 0);
  CHECK(darkness(enlarged) == Approx(200));
  CHECK(drawn(PlacedImage{{10, 5, 1, 1}, checks, Sampling::smooth}).pixel(10, 5)[0] == 128);
}

TEST_CASE("viridis has its published ends and middle and grows lighter") {
  const auto near = [](const Colour& a, double red, double green, double blue) {
    return std::abs(a.red - red) < 0.015 && std::abs(a.green - green) < 0.015 &&
           std::abs(a.blue - blue) < 0.015;
  };
  CHECK(near(viridis(0), 0.267, 0.005, 0.329));
  CHECK(near(viridis(0.5), 0.128, 0.567, 0.551));
  CHECK(near(viridis(1), 0.993, 0.906, 0.144));
  CHECK(viridis(-3).red == viridis(0).red);
  double previous = -1;
  for (int k = 0; k <= 100; ++k) {
    const Colour c = viridis(k / 100.0);
    const double luminance = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
    CHECK(luminance > previous);
    previous = luminance;
  }
}

TEST_CASE("a PNG says its size and is the same twice") {
  Drawing drawing{37, 21, {}};
  drawing.add(Text{{2, 12}, "S = 0.5", 10});
  const std::string png = png_bytes(rasterize(drawing));
  CHECK(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  CHECK(png.substr(16, 8) == std::string("\0\0\0\x25\0\0\0\x15", 8));
  CHECK(png == png_bytes(rasterize(drawing)));
}

TEST_CASE("an SVG holds shapes as shapes, text as text and images as PNG") {
  Drawing drawing{100, 50, {}};
  drawing.add(FilledPolygon{polygon({{1, 2}, {3.5, 4}, {5, 6.25}}), {1, 0, 0}});
  drawing.add(Text{{10, 20}, "a < b & \"c\"", 12, palette::ink, Anchor::centre, true, true});
  drawing.add(PlacedImage{{0, 0, 10, 10}, Image(1, 1, palette::white), Sampling::cells});
  const std::string svg = svg_text(drawing);
  CHECK(svg.find("width=\"100\" height=\"50\"") != std::string::npos);
  CHECK(svg.find("fill=\"#ff0000\" points=\"1,2 3.5,4 5,6.25\"") != std::string::npos);
  CHECK(svg.find(">a &lt; b &amp; &quot;c&quot;</text>") != std::string::npos);
  CHECK(svg.find("rotate(-90 10 20)") != std::string::npos);
  CHECK(svg.find("image-rendering=\"pixelated\"") != std::string::npos);
  // The first bytes of every PNG in base 64, and four digits for every three bytes.
  const std::string start = "base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAAB";
  const std::size_t at = svg.find(start);
  REQUIRE(at != std::string::npos);
  const std::string payload = svg.substr(at + 7, svg.find('"', at) - at - 7);
  const std::size_t length = png_bytes(Image(1, 1, palette::white)).size();
  CHECK(payload.size() == (length + 2) / 3 * 4);
  CHECK(payload.find_first_of('=') ==
        (length % 3 == 0 ? std::string::npos : payload.size() - (3 - length % 3)));
  CHECK(svg.rfind("</svg>\n") == svg.size() - 7);
}

TEST_CASE("drawings refuse sizes and file types that make no sense") {
  CHECK_THROWS_AS(rasterize(Drawing{0, 10, {}}), UsageError);
  CHECK_THROWS_AS(rasterize(Drawing{10, 16385, {}}), UsageError);
  CHECK_THROWS_AS(write_drawing("picture.bmp", Drawing{10, 10, {}}), UsageError);
  CHECK_THROWS_AS(
      write_drawing(STACKABILIZATION_BINARY_DIR "/no/such/folder/picture.png", Drawing{10, 10, {}}),
      OutputError);
}
