#include <algorithm>
#include <cmath>
#include <sstream>

#include "paper_figures/before_after.h"
#include "paper_figures/design_run.h"
#include "paper_figures/figure.h"
#include "paper_figures/folder.h"
#include "paper_figures/shown.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::figures;

namespace {

/// One `g` group of an OBJ text: an axis-parallel box. `before`: boxes written before.
std::string box_text(const std::string& name, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                     int before) {
  const Shape box = solids::box(low, high);
  std::ostringstream text;
  for (Eigen::Index i = 0; i < box.vertex_count(); ++i)
    text << "v " << box.vertices(i, 0) << ' ' << box.vertices(i, 1) << ' ' << box.vertices(i, 2) << '\n';
  text << "g " << name << '\n';
  const int first = before * static_cast<int>(box.vertex_count()) + 1;
  for (Eigen::Index i = 0; i < box.triangles.rows(); ++i)
    text << "f " << box.triangles(i, 0) + first << ' ' << box.triangles(i, 1) + first << ' '
         << box.triangles(i, 2) + first << '\n';
  return text.str();
}

/// A top of 1 x 1 x 0.1 on four legs of 0.1 x 0.1 x 0.9 that stand `inset` from its edges.
std::string table_text(double inset) {
  std::string text = box_text("top", {0, 0, 0.9}, {1, 1, 1}, 0);
  int count = 1;
  for (const double x : {inset, 0.9 - inset})
    for (const double y : {inset, 0.9 - inset}) {
      text += box_text("leg_" + std::to_string(count), {x, y, 0}, {x + 0.1, y + 0.1, 0.9}, count);
      ++count;
    }
  return text;
}

/// The figure, made from an input of these options and a folder that holds "table.obj".
FigureResult made_figure(const Figure& figure, const std::string& options, double inset) {
  const Folder folder;
  folder.file("table.obj", table_text(inset));
  return figure.prepare(Fields::of_file(folder.file("input.json", options)))(ModelFolder{folder.path()});
}

double value_of(const FigureResult& result, const std::string& name) {
  const auto found = std::find_if(result.numbers.begin(), result.numbers.end(),
                                  [&](const Number& number) { return number.name == name; });
  REQUIRE(found != result.numbers.end());
  return found->value.get<double>();
}

/// What reading a task complains about, without the name of the file.
std::string complaint_about_task(const std::string& task) {
  const Folder folder;
  const std::string text =
      message_of<InputError>([&] { read_design_task(Fields::of_file(folder.file("input.json", task))); });
  const std::size_t colon = text.find(": ");
  return colon == std::string::npos ? text : text.substr(colon + 2);
}

constexpr const char* camera_field = R"("camera": {"azimuth": 35, "elevation": 12})";
const std::string table_task =
    R"("model": {"file": "table.obj"}, "direction": [0, 0, 1], "expansions": 1, "target": )";

}  // namespace

TEST_CASE("a task that cannot be is refused where it stands") {
  const std::string model = R"({"model": {"file": "a.obj"}, )";
  CHECK(complaint_about_task("{" + table_task + "0.5}") == "accepted");
  CHECK(complaint_about_task("{" + table_task + "1}") == "/target: expected a stackability below 1");
  CHECK(complaint_about_task("{" + table_task + R"(0.5, "boxes": "round"})") ==
        "/boxes: expected oriented or frame");
  CHECK(complaint_about_task("{" + table_task + R"(0.5, "preset": "fast"})") ==
        "/preset: expected refined or paper");
  CHECK(complaint_about_task(model + R"("target": 0.5, "expansions": 1})") ==
        "/direction: expected such an entry, found none");
  CHECK(complaint_about_task(model + R"("direction": [0, 0, 1], "target": 0.5, "expansions": 0})") ==
        "/expansions: expected a whole number from 1 to 10000");
}

TEST_CASE("a part that does not exist cannot be left out") {
  const Folder folder;
  folder.file("table.obj", table_text(0));
  const Fields fields =
      Fields::of_file(folder.file("input.json", "{" + table_task + R"(0, "remove": ["drawer"]})"));
  CHECK_THROWS_AS(structured_shape(read_design_task(fields), ModelFolder{folder.path()}), InputError);
}

TEST_CASE("scenes side by side do not overlap as the camera sees them, and share their ground") {
  const Camera camera{50, 20};
  const Direction up(0.2, 0, 1);
  std::vector<Scene> scenes(3);
  scenes[0].add({solids::box({0, 0, 0}, {1, 2, 3}), {palette::input}});
  scenes[1].add({solids::box({5, 5, 5}, {6, 6, 9}), {palette::input}});
  scenes[2].add({solids::box({-4, 0, -7}, {1, 1, 1}), {palette::input}});
  const Scene row = side_by_side(scenes, up, camera);
  REQUIRE(row.meshes.size() == 3);
  ViewOptions eye;
  eye.azimuth_degrees = camera.azimuth;
  eye.elevation_degrees = camera.elevation;
  const Eigen::Vector3d right = turned_view(up, eye).right;
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(range_along(row.meshes[k].shape, up.unit()).low == Approx(0).margin(1e-12));
    if (k > 0)
      CHECK(range_along(row.meshes[k].shape, right).low > range_along(row.meshes[k - 1].shape, right).high);
  }
}

TEST_CASE("figure 6 compares solutions that are equally compact, one of them squashed") {
  const FigureResult result = made_figure(
      figure_06(),
      R"({"task": {)" + table_task + R"(0.1}, "longest_edge": 0.05, "copies": 2, )" + camera_field + "}", 0);
  CHECK(value_of(result, "gap scaling: f_max") ==
        Approx(value_of(result, "structure-aware: f_max")).epsilon(1e-4));
  CHECK(value_of(result, "structure-aware: h") == Approx(1).epsilon(1e-9));
  CHECK(value_of(result, "structure-aware: S") >= 0.1);
  // Every column below the top is as high as the whole, so h falls exactly as the gap does.
  CHECK(value_of(result, "gap scaling: h") ==
        Approx(value_of(result, "factor of the gap function")).epsilon(1e-6));
  CHECK(value_of(result, "gap scaling: S") == Approx(0).margin(1e-6));
  for (const Claim& claim : result.claims) CHECK(claim.holds);
}

TEST_CASE("the pieces of figure 14 take up what their own boxes do") {
  constexpr double inset = 0.2;
  const auto piece = [](const std::string& name, const std::string& without) {
    return R"({"name": ")" + name + R"(", )" + table_task + R"(-1, "remove": [)" + without + "]}";
  };
  const std::string legs = R"("leg_1", "leg_2", "leg_3", "leg_4")";
  const auto input = [&](const std::string& pieces) {
    return R"({"whole": {"file": "table.obj"}, "direction": [0, 0, 1], "copies": 2, "pieces": [)" + pieces +
           "], " + camera_field + "}";
  };
  const FigureResult result =
      made_figure(figure_14(), input(piece("top", legs) + ", " + piece("legs", R"("top")")), inset);
  // Neither piece saves anything of its own box: 1 x 1 x 0.1, and 0.6 x 0.6 x 0.9 below it.
  CHECK(value_of(result, "whole: S") == Approx(0).margin(1e-9));
  CHECK(value_of(result, "all pieces, as they are cut: S") ==
        Approx(1 - 0.1 - std::pow(1 - 2 * inset, 2) * 0.9).epsilon(1e-9));
  CHECK(result.claims[0].holds);
  const FigureResult twice =
      made_figure(figure_14(), input(piece("top", legs) + ", " + piece("table", R"("leg_1")")), inset);
  CHECK(!twice.claims[0].holds);  // parts of the table are in both
}
