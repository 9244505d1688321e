#include <algorithm>
#include <cmath>
#include <numbers>

#include "generator/modelling.h"
#include "paper_figures/figure.h"
#include "paper_figures/shown.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/rendering/foot.h"
#include "stackabilization/rendering/stacking_scene.h"
#include "stackabilization/stacking/stack.h"

namespace stackabilization::figures {
namespace {

/// A stool whose legs stand outside its seat, so that the copy above only has to miss them: lengths in
/// metres.
struct Stool {
  int legs = 3;
  double seat = 0.15, reach = 0.2, height = 0.45;  ///< radius of the seat, distance of the feet, height
};

struct Figure03Options {
  Stool stool;
  double twist_degrees = 0;  ///< from copy to copy
  int stools = 5;
  Camera stool_camera;
  ModelSource cup;
  double lean_degrees = 0;  ///< of the cups, to one side and to the other in turn
  int cups = 6;
  double enlarged = 1;  ///< the cups are drawn this many times as large as the stools
  Camera cup_camera;
};

Figure03Options read_figure_03(const Fields& fields) {
  const Fields twisted = fields.object("twisted"), zigzag = fields.object("zigzag");
  Figure03Options options;
  options.stool = {twisted.whole("legs", 3, 8), twisted.number("seat"), twisted.number("reach"),
                   twisted.number("height")};
  if (!(options.stool.seat > 0) || !(options.stool.reach > options.stool.seat))
    twisted.refuse("reach", "a length greater than that of the seat");
  options.twist_degrees = twisted.number("twist_degrees");
  options.stools = read_copies(twisted, 2);
  options.stool_camera = read_camera(twisted);
  options.cup = read_model_source(zigzag.object("model"));
  options.lean_degrees = zigzag.number("lean_degrees");
  options.cups = read_copies(zigzag, 2);
  options.cup_camera = read_camera(zigzag);
  options.enlarged = zigzag.number("enlarged");
  if (!(options.enlarged > 0)) zigzag.refuse("enlarged", "a factor above 0");
  return options;
}

Shape stool_shape(const Stool& stool) {
  constexpr double seat_thickness = 0.03, leg = 0.026, arm = 0.018;
  std::vector<Shape> pieces = {
      models::slab({stool.height - seat_thickness, stool.height, 0.006, 3},
                   [&](double distance) { return models::circle(48)(stool.seat - distance); })};
  const double top = stool.height - seat_thickness / 2;
  for (int k = 0; k < stool.legs; ++k) {
    const double angle = 2 * std::numbers::pi * k / stool.legs;
    const Eigen::Vector3d outwards(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    const Eigen::Vector3d shoulder = 0.94 * stool.reach * outwards + top * up;
    pieces.push_back(models::rod(stool.reach * outwards, shoulder, {leg, leg}));
    pieces.push_back(models::rod(0.8 * stool.seat * outwards + top * up, shoulder, {arm, arm}));
  }
  Shape shape = models::joined(pieces);
  shape.unit = Unit::metre;
  return shape;
}

/// Where copies of a stack are: along a line, or turned one against the other.
std::vector<Shape> placed(const Shape& shape, const StackResult& stack, const Eigen::Vector3d& up) {
  std::vector<Shape> copies;
  for (const StackedCopy& copy : stack.copies)
    copies.push_back(transformed(transformed(shape, copy.transform), Eigen::Matrix3d::Identity(),
                                 copy.offset_length * up));
  return copies;
}

/// Line strip through the centres of the copies (the paper's stacking trajectory).
void add_trajectory(ScenePanel& panel, const std::vector<Shape>& copies) {
  Points line(static_cast<Eigen::Index>(copies.size()), 3);
  SceneLines dots{{}, palette::ink, 3};
  for (std::size_t k = 0; k < copies.size(); ++k) {
    line.row(static_cast<Eigen::Index>(k)) = copies[k].vertices.colwise().mean();
    dots.polylines.emplace_back(line.row(static_cast<Eigen::Index>(k)));
  }
  panel.over.lines = {SceneLines{{line}, palette::ink, 3}, std::move(dots)};
}

/// Copies that stand on their neighbours only, the conflict ringed; and where they have to stand.
struct TwistedStacks {
  StackResult stack;
  std::vector<Shape> neighbours, all;
};

TwistedStacks twisted_stacks(const Figure03Options& options) {
  const Direction up(0, 0, 1);
  const Shape stool = stool_shape(options.stool);
  StackOptions stacking;
  stacking.twist_degrees = options.twist_degrees;
  stacking.axis_point = Eigen::Vector3d::Zero();
  stacking.copies = options.stools;
  TwistedStacks result{stack_copies(stool, up, stacking), {}, {}};
  result.all = placed(stool, result.stack, up.unit());
  StackResult resting = result.stack;
  for (std::size_t k = 0; k < resting.copies.size(); ++k)
    resting.copies[k].offset_length = static_cast<double>(k) * result.stack.copies[1].offset_length;
  result.neighbours = placed(stool, resting, up.unit());
  return result;
}

Panel neighbours_panel(const TwistedStacks& stacks, const Figure03Options& options) {
  ScenePanel panel =
      scene_panel(stack_scene(stacks.neighbours, palette::input), Direction(0, 0, 1), options.stool_camera);
  add_trajectory(panel, stacks.neighbours);
  const StackConflict& conflict = stacks.stack.conflicts.front();
  const auto above = static_cast<std::size_t>(conflict.above);
  panel.scene.meshes[above].colours = {mix(palette::input, palette::contact, 0.6)};
  const double angle = options.twist_degrees * conflict.above * std::numbers::pi / 180;
  // The leg that is seen best: the one nearest to the viewer.
  const View view = turned_view(Direction(0, 0, 1), {options.stool_camera.azimuth});
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (int k = 0; k < options.stool.legs; ++k) {
    const double turned = angle + 2 * std::numbers::pi * k / options.stool.legs;
    const Eigen::Vector3d leg(std::cos(turned), std::sin(turned), 0);
    if (view.towards.dot(leg) > view.towards.dot(best)) best = leg;
  }
  const double low = conflict.above * stacks.stack.copies[1].offset_length;
  panel.over.rings = {{options.stool.reach * best + (low + conflict.overlap / 2) * Eigen::Vector3d::UnitZ(),
                       0.3 * conflict.overlap}};
  return {std::move(panel),
          "(a) twist " + significant_text(options.twist_degrees, 5) + "°",
          {"copy " + std::to_string(conflict.above + 1) + " cuts into copy " +
           std::to_string(conflict.below + 1)},
          1};
}

FigureResult make_figure_03(const Figure03Options& options, const ModelFolder& models) {
  const Direction up(0, 0, 1);
  const TwistedStacks stacks = twisted_stacks(options);
  if (stacks.stack.conflicts.empty()) throw InputError("the twisted stools do not get in each other's way");
  ScenePanel resolved = scene_panel(stack_scene(stacks.all, palette::input), up, options.stool_camera);
  add_trajectory(resolved, stacks.all);

  const Shape cup = models.read(options.cup);
  const Line hinge{foot_of(cup, up), Direction(0, 1, 0)};
  StackOptions zigzag;
  zigzag.copies = options.cups;
  zigzag.poses = {rotation_about(hinge, options.lean_degrees), rotation_about(hinge, -options.lean_degrees)};
  const StackResult cups = stack_copies(cup, up, zigzag);
  const std::vector<Shape> leaning = placed(cup, cups, up.unit());
  std::vector<Shape> drawn;
  for (const Shape& copy : leaning)
    drawn.push_back(
        transformed(copy, options.enlarged * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()));
  ScenePanel cup_panel = scene_panel(stack_scene(drawn, palette::input), up, options.cup_camera);
  add_trajectory(cup_panel, drawn);

  PanelRow row;
  row.height = 0.7;
  row.scale = PanelScale::common;
  row.panels = {
      neighbours_panel(stacks, options),
      {std::move(resolved), "(b) the same", {"every copy checked against all"}, 1},
      {std::move(cup_panel),
       "(c) leaning bowls",
       {"zigzag trajectory", "(drawn " + significant_text(options.enlarged, 5) + " times as large)"},
       1}};
  const StackConflict& conflict = stacks.stack.conflicts.front();
  const Eigen::Vector3d first = leaning[0].vertices.colwise().mean(),
                        second = leaning[1].vertices.colwise().mean();
  return {panel_sheet({row}),
          {{"twist from copy to copy", options.twist_degrees, "degrees"},
           {"lift from stool to stool, neighbours only", stacks.stack.copies[1].offset_length, "m"},
           {"first copy that cuts into a copy that is not its neighbour", conflict.above + 1},
           {"depth of that conflict along r", conflict.overlap, "m"},
           {"height that the conflicts cost", stacks.stack.conflict_height, "m"},
           {"sideways step of the trajectory of the bowls", std::abs(second.x() - first.x()), "m"}},
          {{"neighbours are clear of each other, yet copies that are not adjacent overlap",
            conflict.above - conflict.below > 1},
           {"the trajectory of the twisted stools is straight, that of the leaning bowls is not",
            second.x() != first.x()}}};
}

}  // namespace

Figure figure_03() {
  return figure(3, "Stacks of rotated copies: conflict of copies that are no neighbours, zigzag trajectory",
                read_figure_03, make_figure_03);
}

}  // namespace stackabilization::figures
