#include <limits>
#include <string>

#include "common/plot_drawing.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

Plot plot_of(std::vector<Eigen::Vector2d> points, bool logarithmic) {
  return {"title", {"across", logarithmic}, {"up", logarithmic}, {{"series", std::move(points)}}};
}

/// Points of the line of the series, pixels: the one in its colour with most points.
PlanePoints curve(const Plot& plot) {
  PlanePoints longest;
  for (const DrawingElement& element : drawing_of(plot).elements)
    if (const auto* line = std::get_if<Polyline>(&element);
        line && line->colour.blue == palette::upper.blue && line->points.rows() > longest.rows())
      longest = line->points;
  return longest;
}

}  // namespace

TEST_CASE("a power law is a straight line on logarithmic axes") {
  const PlanePoints line = curve(plot_of({{1, 1}, {10, 100}, {1000, 1e6}}, true));
  REQUIRE(line.rows() == 3);
  const Eigen::RowVector2d a = line.row(1) - line.row(0), b = line.row(2) - line.row(0);
  CHECK(a.x() * b.y() - a.y() * b.x() == Approx(0).margin(1e-9));
  CHECK(b.x() == Approx(3 * a.x()));
  CHECK(a.x() > 0);
  CHECK(a.y() < 0);  // upwards
}

TEST_CASE("a linear function is a straight line on linear axes, and negative values are drawn") {
  const PlanePoints line = curve(plot_of({{-2, -1}, {0, 0}, {4, 2}}, false));
  REQUIRE(line.rows() == 3);
  CHECK((line.row(2) - line.row(1)).isApprox(2 * (line.row(1) - line.row(0)), 1e-12));
}

TEST_CASE("a plot leaves out what its axes cannot show") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(curve(plot_of({{1, 1}, {2, 0}, {3, -1}, {4, infinity}, {8, 2}}, true)).rows() == 2);
  const Plot nothing = plot_of({{0, 1}}, true);
  CHECK_FALSE(has_points(nothing));
  CHECK_THROWS_AS(drawing_of(nothing), UsageError);
  CHECK(has_points(plot_of({{0, 1}}, false)));
}

TEST_CASE("a single point, and equal values, still make a picture") {
  for (const bool logarithmic : {false, true})
    for (const auto& points :
         {std::vector<Eigen::Vector2d>{{5, 5}}, std::vector<Eigen::Vector2d>{{5, 5}, {5, 5}}})
      CHECK(drawing_of(plot_of(points, logarithmic)).width > 0);
}

TEST_CASE("names of series that end at the same height stand below each other, inside the picture") {
  Plot plot = plot_of({}, false);
  plot.series.clear();
  for (int k = 0; k < 11; ++k) plot.series.push_back({"name " + std::to_string(k), {{1, k}, {2, 0}}});
  const Drawing drawing = drawing_of(plot);
  std::vector<double> heights;
  for (const DrawingElement& element : drawing.elements)
    if (const auto* text = std::get_if<Text>(&element); text && text->text.starts_with("name "))
      heights.push_back(text->at.y());
  REQUIRE(heights.size() == 11);
  for (std::size_t k = 1; k < heights.size(); ++k) CHECK(heights[k] - heights[k - 1] > 15);
  CHECK(heights.front() > 0);
  CHECK(heights.back() < drawing.height);
}

TEST_CASE("several plots stand two in a row, each in its own place, and one without points leaves it empty") {
  const Plot plot = plot_of({{1, 1}, {2, 4}}, false);
  const Drawing single = drawing_of(plot);
  const Drawing several = drawing_of({plot, plot_of({{0, 1}}, true), plot});
  CHECK(several.width == 2 * single.width);
  CHECK(several.height == 2 * single.height);
  std::vector<Eigen::Vector2d> titles;
  for (const DrawingElement& element : several.elements)
    if (const auto* text = std::get_if<Text>(&element); text && text->text == "title")
      titles.push_back(text->at);
  REQUIRE(titles.size() == 2);
  CHECK(titles[1].x() == titles[0].x());
  CHECK(titles[1].y() == titles[0].y() + single.height);
  CHECK_THROWS_AS(drawing_of(std::vector<Plot>{}), UsageError);
}
