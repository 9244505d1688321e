#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/curve_plot.h"
#include "support/catch.h"
#include "support/picture_checks.h"

using namespace stackabilization;

namespace {

const Rectangle plot_place{40, 30, 700, 500};
constexpr double text_size = 20;

CurvePlot plot_of(std::vector<Eigen::Vector2d> points) {
  CurvePlot plot;
  plot.x.title = "position";
  plot.y.title = "gap";
  plot.series = {{"f", palette::upper, std::move(points), PlotLine::solid, PlotMark::square}};
  return plot;
}

/// The label that says `words`.
std::optional<Text> label(const std::vector<DrawingElement>& elements, const std::string& words) {
  for (const DrawingElement& element : elements)
    if (const auto* text = std::get_if<Text>(&element); text != nullptr && text->text == words) return *text;
  return std::nullopt;
}

/// Polylines of a series: those in its colour and as thick as data.
std::vector<PlanePoints> lines_of(const std::vector<DrawingElement>& elements, const Colour& colour) {
  std::vector<PlanePoints> lines;
  for (const DrawingElement& element : elements)
    if (const auto* line = std::get_if<Polyline>(&element);
        line != nullptr && bytes_of(line->colour) == bytes_of(colour) && line->width > 2)
      lines.push_back(line->points);
  return lines;
}

}  // namespace

TEST_CASE("a point of the data lands where the axes say") {
  const CurvePlot plot = plot_of({{0, 0}, {2, 30}, {10, 50}});
  const std::vector<DrawingElement> elements = plot_elements(plot, plot_place, text_size);
  const PlotArea area(plot, plot_place, text_size);
  for (const double x : {0.0, 2.0, 10.0}) {
    const std::optional<Text> tick = label(elements, std::to_string(static_cast<int>(x)));
    REQUIRE(tick);
    if (x > 0) CHECK(tick->at.x() == Approx(area.at({x, 0}).x()).margin(1e-9));
  }
  const std::optional<Text> thirty = label(elements, "30"), fifty = label(elements, "50");
  REQUIRE(thirty);
  REQUIRE(fifty);
  // Labels stand a little below the middle of their tick, all by the same amount.
  CHECK(thirty->at.y() - fifty->at.y() == Approx(area.at({0, 30}).y() - area.at({0, 50}).y()));
  CHECK(thirty->at.y() - area.at({0, 30}).y() == Approx(0.35 * text_size));
  const std::vector<PlanePoints> lines = lines_of(elements, palette::upper);
  REQUIRE(lines.size() == 1);
  REQUIRE(lines[0].rows() == 3);
  CHECK((lines[0].row(1).transpose() - area.at({2, 30})).norm() == Approx(0).margin(1e-9));
}

TEST_CASE("linear axes keep proportions, logarithmic ones ratios") {
  CurvePlot plot = plot_of({{1, 1}, {1000, 1000}});
  const PlotArea linear(plot, plot_place, text_size);
  const auto x = [](const PlotArea& area, double value) { return area.at({value, 1}).x(); };
  CHECK(x(linear, 300) - x(linear, 200) == Approx(x(linear, 800) - x(linear, 700)));
  plot.x.scale = AxisScale::logarithmic;
  const PlotArea logarithmic(plot, plot_place, text_size);
  CHECK(x(logarithmic, 1) == Approx(logarithmic.rectangle().x));
  CHECK(x(logarithmic, 1000) == Approx(logarithmic.rectangle().right()));
  CHECK(x(logarithmic, 20) - x(logarithmic, 10) == Approx(x(logarithmic, 200) - x(logarithmic, 100)));
}

TEST_CASE("default ranges are round and hold all data; given ones are kept") {
  CurvePlot plot = plot_of({{0.13, -0.7}, {9.2, 4.1}});
  const PlotArea area(plot, plot_place, text_size);
  CHECK(area.x().low == Approx(0).margin(1e-12));
  CHECK(area.x().high == Approx(10));
  CHECK(area.y().low == Approx(-1));
  CHECK(area.y().high == Approx(5));
  plot.x.range = Range{0, 7};
  const PlotArea given(plot, plot_place, text_size);
  CHECK(given.x().high == 7);
  CHECK(!given.holds({9.2, 4.1}));
  CHECK(PlotArea(plot_of({{3, 3}}), plot_place, text_size).holds({3, 3}));  // one point has a range too
}

TEST_CASE("what is off the axes or not finite breaks the line") {
  CurvePlot plot = plot_of({{0, 1}, {1, 2}, {2, NAN}, {3, 1}, {4, 2}, {5, 99}, {6, 1}, {7, 1}});
  plot.y.range = Range{0, 10};
  const std::vector<DrawingElement> elements = plot_elements(plot, plot_place, text_size);
  CHECK(lines_of(elements, palette::upper).size() == 3);
  const PlotArea area(plot, plot_place, text_size);
  for (const PlanePoints& line : lines_of(elements, palette::upper))
    CHECK(line.col(1).minCoeff() >= area.rectangle().y);
}

TEST_CASE("a plot stays inside its picture and names its series") {
  CurvePlot plot = plot_of({{0, 0}, {1, 12345678}});
  plot.series.push_back({"a reference", palette::lower, {{0, 5}, {1, 1e7}}, PlotLine::thin});
  plot.series.push_back({"an area", palette::contact, {{0, 5}, {1, 1e7}}, PlotLine::over_area});
  plot.notes = {{{0.5, 1e6}, "here"}};
  const Drawing drawing = curve_plot(plot, {800, 500, "a plot"});
  check_nothing_clipped(drawing);
  for (const char* const words : {"f", "a reference", "position", "gap", "here", "a plot"})
    CHECK(says(drawing, words));
  CHECK(svg_text(drawing) == svg_text(curve_plot(plot, {800, 500, "a plot"})));
}

TEST_CASE("labels of a narrow plot stay apart") {
  for (const double width : {160.0, 200.0, 300.0, 500.0}) {
    CurvePlot plot = plot_of({{-0.41, 0}, {0.41, 1}});
    plot.x.range = Range{-0.41, 0.41};
    const Rectangle narrow{0, 0, width, 300};
    const PlotArea area(plot, narrow, text_size);
    std::vector<std::pair<double, double>> labels;  // left and right ends
    for (const DrawingElement& element : plot_elements(plot, narrow, text_size))
      if (const auto* text = std::get_if<Text>(&element);
          text != nullptr && text->at.y() == Approx(area.rectangle().bottom() + 1.15 * text_size))
        labels.emplace_back(text->at.x() - text_width(*text) / 2, text->at.x() + text_width(*text) / 2);
    REQUIRE(!labels.empty());
    std::sort(labels.begin(), labels.end());
    for (std::size_t k = 1; k < labels.size(); ++k) CHECK(labels[k].first > labels[k - 1].second);
  }
}

TEST_CASE("plots without data or with impossible axes are refused") {
  CHECK_THROWS_AS(curve_plot(CurvePlot{}), UsageError);
  CHECK_THROWS_AS(curve_plot(plot_of({{NAN, 1}})), UsageError);
  CurvePlot plot = plot_of({{0, 1}, {1, 2}});
  plot.x.scale = AxisScale::logarithmic;
  CHECK_THROWS_AS(curve_plot(plot), UsageError);
  plot = plot_of({{0, 1}, {1, 2}});
  plot.y.range = Range{2, 2};
  CHECK_THROWS_AS(curve_plot(plot), UsageError);
  plot.y.range = Range{0, INFINITY};
  CHECK_THROWS_AS(curve_plot(plot), UsageError);
}
