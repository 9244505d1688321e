#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/panel_sheet.h"
#include "stackabilization/rendering/stacking_scene.h"
#include "support/catch.h"
#include "support/picture_checks.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

ScenePanel box_panel(const Eigen::Vector3d& size, const Colour& colour) {
  ScenePanel panel;
  panel.scene.add({solids::box(size), {colour}});
  panel.azimuth_degrees = 0;
  panel.elevation_degrees = 0;
  return panel;
}

/// Bounds of the pixels of a colour.
struct Extent {
  int left = 100000, right = -1, top = 100000, bottom = -1;
};
Extent extent_of(const Image& image, const Colour& colour) {
  Extent extent;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto p = image.pixel(x, y);
      const double high = std::max({p[0], p[1], p[2]});
      if (high < 60) continue;
      const double strongest = std::max({colour.red, colour.green, colour.blue});
      if (std::abs(p[0] / high - colour.red / strongest) + std::abs(p[1] / high - colour.green / strongest) +
              std::abs(p[2] / high - colour.blue / strongest) >
          0.12)
        continue;
      extent = {std::min(extent.left, x), std::max(extent.right, x), std::min(extent.top, y),
                std::max(extent.bottom, y)};
    }
  return extent;
}

}  // namespace

TEST_CASE("scenes of a common scale keep their proportions and stand on one ground") {
  PanelRow row;
  row.scale = PanelScale::common;
  row.panels = {{box_panel({2, 2, 4}, palette::input), "tall", {}, 1},
                {box_panel({2, 2, 1}, palette::output), "low", {}, 1}};
  const Drawing drawing = panel_sheet({row});
  check_nothing_clipped(drawing);
  const Image image = rasterize(drawing);
  const Extent tall = extent_of(image, palette::input), low = extent_of(image, palette::output);
  CHECK(tall.bottom - tall.top == Approx(4.0 * (low.bottom - low.top)).epsilon(0.03));
  CHECK(tall.right - tall.left == Approx(low.right - low.left).epsilon(0.03));
  CHECK(std::abs(tall.bottom - low.bottom) <= 1);

  row.scale = PanelScale::own;
  const Image own = rasterize(panel_sheet({row}));
  const Extent wide = extent_of(own, palette::output);
  CHECK(wide.right - wide.left > 1.5 * (low.right - low.left));
}

TEST_CASE("a row of scenes takes no more height than they use, with a plot in it all of it") {
  PanelRow row;
  row.height = 2;
  row.panels = {{box_panel({4, 1, 1}, palette::input), "", {}, 1}};
  const Drawing low = panel_sheet({row});
  CHECK(low.height < low.width / 2);  // a box four times as wide as high
  const Extent box = extent_of(rasterize(low), palette::input);
  CHECK(box.right - box.left > 0.85 * low.width);  // and no narrower for it
  CHECK(box.right - box.left == Approx(4.0 * (box.bottom - box.top)).epsilon(0.03));
  CurvePlot plot;
  plot.series = {{"", palette::upper, {{0, 1}, {1, 2}}}};
  row.panels.push_back({plot, "", {}, 1});
  CHECK(panel_sheet({row}).height >= 2 * low.width);
}

TEST_CASE("arrows, rings, lines and labels are where the scene has their points") {
  PanelRow row;
  ScenePanel panel =
      box_panel({2, 2, 2}, palette::input);  // centred at the origin or not: only heights count
  const Range along = range_along(panel.scene.meshes[0].shape, Eigen::Vector3d::UnitZ());
  const Range across = range_along(panel.scene.meshes[0].shape, Eigen::Vector3d::UnitX());
  const Eigen::Vector3d low(across.low, 0, along.low), high(across.high, 0, along.high);
  panel.over.labels = {{low, "low"}, {high, "high"}};
  panel.over.arrows = {{low, high, palette::contact}};
  panel.over.dimensions = {{low, high, "two", Anchor::left}, {low, high, "right", Anchor::right}};
  row.panels = {{panel, "", {}, 1}};
  const Drawing drawing = panel_sheet({row});
  check_nothing_clipped(drawing);
  const Extent box = extent_of(rasterize(panel_sheet({row})), palette::input);
  std::vector<Eigen::Vector2d> labels;
  for (const DrawingElement& element : drawing.elements)
    if (const auto* text = std::get_if<Text>(&element); text != nullptr && !text->upwards)
      labels.push_back(text->at);
  REQUIRE(labels.size() == 2);
  CHECK(std::abs(labels[0].x() - box.left) < 2.5);
  CHECK(std::abs(labels[0].y() - box.bottom) < 2.5);
  CHECK(std::abs(labels[1].x() - box.right) < 2.5);
  CHECK(std::abs(labels[1].y() - box.top) < 2.5);
}

TEST_CASE("a sheet holds scenes, plots, gaps and maps side by side, with captions and a legend") {
  const Shape cup = solids::frustum_shell({});
  const Direction up(0, 0, 1);
  CurvePlot plot;
  plot.series = {{"S", palette::upper, {{0, 1}, {1, 2}}}};
  StackabilityMap map;
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)})
    map.samples.push_back({direction, 0, 0, 0, direction.z()});
  ScenePanel stack;
  stack.scene = stack_scene(copies_of(cup, {0, 0, 4.25}, 3), palette::input);
  PanelRow first, second;
  first.panels = {{stack, "a stack", {"of three cups that stand in each other and need many words"}, 2},
                  {plot, "a plot", {}, 3}};
  second.panels = {{height_field_by_scanline(cup, up, window_around(cup, up, 40)), "a gap", {}, 1},
                   {map, "a map", {}, 1}};
  PanelSheetOptions options;
  options.title = "everything";
  options.legend = {{LegendMark::swatch, palette::input, "cup"}};
  const Drawing drawing = panel_sheet({first, second}, options);
  check_nothing_clipped(drawing);
  for (const char* const words : {"everything", "a stack", "a plot", "a gap", "a map", "cup"})
    CHECK(says(drawing, words));
  CHECK(png_bytes(rasterize(drawing)) == png_bytes(rasterize(panel_sheet({first, second}, options))));
}

TEST_CASE("rows and panels that cannot be drawn are refused") {
  PanelRow row;
  CHECK_THROWS_AS(panel_sheet({row}), UsageError);
  row.panels = {{box_panel({1, 1, 1}, palette::input), "", {}, 0}};
  CHECK_THROWS_AS(panel_sheet({row}), UsageError);
  row.panels[0].share = 1;
  row.height = 0;
  CHECK_THROWS_AS(panel_sheet({row}), UsageError);
  row.height = 0.5;
  row.panels[0].content = ScenePanel{};
  CHECK_THROWS_AS(panel_sheet({row}), UsageError);
}

TEST_CASE("a stack of copies is as high as its steps make it") {
  const Shape cup = solids::frustum_shell({});
  const std::vector<Shape> copies = copies_of(cup, {0, 0.5, 2}, 4);
  REQUIRE(copies.size() == 4);
  CHECK(copies[0].vertices == cup.vertices);
  CHECK((copies[3].vertices - cup.vertices)
            .rowwise()
            .mean()
            .isApprox(Eigen::VectorXd::Constant(cup.vertex_count(), 7.5 / 3)));
  const Scene scene = stack_scene(copies, palette::input);
  CHECK(bytes_of(scene.meshes[0].colours[0]) == bytes_of(scene.meshes[2].colours[0]));
  CHECK(bytes_of(scene.meshes[0].colours[0]) != bytes_of(scene.meshes[1].colours[0]));
}
