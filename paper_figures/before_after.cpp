#include "paper_figures/before_after.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paper_figures/shown.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/rendering/foot.h"

namespace stackabilization::figures {
namespace {

/// Free space between neighbours, fraction of their mean width.
constexpr double space_between = 0.15;

/// Of all surfaces along a unit vector.
Range extent_along(const Scene& scene, const Eigen::Vector3d& axis) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Range range{infinite, -infinite};
  for (const SceneMesh& mesh : scene.meshes) {
    const Range own = range_along(mesh.shape, axis);
    range = {std::min(range.low, own.low), std::max(range.high, own.high)};
  }
  return range;
}

Scene moved(Scene scene, const Eigen::Vector3d& by) {
  for (SceneMesh& mesh : scene.meshes) mesh.shape.vertices.rowwise() += by.transpose();
  for (SceneLines& lines : scene.lines)
    for (Points& line : lines.polylines) line.rowwise() += by.transpose();
  return scene;
}

}  // namespace

double read_row_height(const Fields& fields) {
  constexpr double highest = 10;
  const double height = fields.number("height");
  if (!(height > 0 && height <= highest)) fields.refuse("height", "a number above 0 and up to 10");
  return height;
}

Scene side_by_side(const std::vector<Scene>& scenes, const Direction& up, const Camera& camera) {
  ViewOptions eye;
  eye.azimuth_degrees = camera.azimuth;
  eye.elevation_degrees = camera.elevation;
  const Eigen::Vector3d right = turned_view(up, eye).right;
  std::vector<Range> widths;
  double mean = 0;
  for (const Scene& scene : scenes) {
    widths.push_back(extent_along(scene, right));
    mean += widths.back().length() / static_cast<double>(scenes.size());
  }
  Scene row;
  double next = 0;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const double ground = extent_along(scenes[k], up.unit()).low;
    row.add(moved(scenes[k], (next - widths[k].low) * right - ground * up.unit()));
    next += widths[k].length() + space_between * mean;
  }
  return row;
}

double stack_height(const MeasuredShape& shape, int copies) {
  return shape.measured.extent + (copies - 1) * shape.measured.f_max;
}

SceneDimension stack_dimension(const MeasuredShape& shape, int copies, Anchor side) {
  const Eigen::Vector3d up = Direction(shape.measured.direction).unit();
  const double height = stack_height(shape, copies);
  return {Eigen::Vector3d::Zero(), height * up, length_text(height, shape.shape.unit), side};
}

Scene grounded_stack(const MeasuredShape& shape, int copies, const Colour& colour) {
  MeasuredShape grounded = shape;
  grounded.shape = on_ground(shape.shape, Direction(shape.measured.direction));
  return stack_of(grounded, copies, colour);
}

ScenePanel single_stack_panel(const MeasuredShape& shape, int copies, const Colour& colour,
                              const Camera& camera) {
  const Direction up(shape.measured.direction);
  return scene_panel(grounded_stack(shape, copies, colour), up, camera);
}

ScenePanel stacks_panel(const ImprovedShape& shapes, int copies, const Camera& camera) {
  const Direction up(shapes.after.measured.direction);
  return scene_panel(side_by_side({grounded_stack(shapes.before, copies, palette::input),
                                   grounded_stack(shapes.after, copies, palette::output)},
                                  up, camera),
                     up, camera);
}

std::string change_text(const ImprovedShape& shapes) {
  return "S " + ratio_text(shapes.before.measured.value) + " to " + ratio_text(shapes.after.measured.value);
}

std::vector<Number> design_numbers(const std::string& name, const DesignRun& run) {
  const Candidate& best = run.best();
  return {{name + ": S before", run.result.before.measured.value},
          {name + ": S after", best.measured.value},
          {name + ": D", best.energy.distortion.total()}};
}

bool keeps_height(const ImprovedShape& shapes) {
  const double before = shapes.before.measured.extent, after = shapes.after.measured.extent;
  return std::abs(after - before) <= tolerance::relative * before;
}

NamedTask read_named_task(const Fields& fields) {
  return {fields.text("name"), read_design_task(fields), read_camera(fields)};
}

StackedTask read_stacked_task(const Fields& fields) {
  return {read_design_task(fields.object("task")), read_camera(fields), read_copies(fields)};
}

std::vector<LegendEntry> before_after_entries() {
  return {{LegendMark::swatch, palette::input, "before"}, {LegendMark::swatch, palette::output, "after"}};
}

}  // namespace stackabilization::figures
