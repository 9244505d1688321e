#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "apps/common/command.h"
#include "apps/common/measurement.h"
#include "apps/common/output.h"
#include "apps/common/progress.h"
#include "apps/common/rendering.h"
#include "apps/common/values.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/convex_hull.h"
#include "stackabilization/stacking/place.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization::apps {

namespace {

/// Places along the longer side of a map, where no step is given.
constexpr double default_map_places = 32;
/// Cells that bound an integral take a hundred times the work of those that bound a height.
constexpr std::int64_t default_gap_cells = 2000;

enum class PlaceChoice { given, best };

const Choices<PlaceGoal> goals = {
    {"height", PlaceGoal::height}, {"gap", PlaceGoal::gap}, {"volume", PlaceGoal::volume}};

struct DropCommandOptions {
  CommonOptions common;
  std::string onto;
  std::optional<Eigen::Vector3d> direction;
  ContactSemantics semantics = ContactSemantics::solid;
  PlaceChoice place = PlaceChoice::given;
  std::optional<PlaceGoal> goal;
  std::optional<double> overlap;
  bool turn = false;
  std::vector<Eigen::Vector2d> region;
  std::optional<Length> eps, step;
  std::optional<std::int64_t> max_cells;
  std::optional<std::string> output, map, picture;

  bool needs_map() const { return map || picture; }
};

/// The shape that falls, and what it falls on.
struct Scene {
  Model item, base;
  Direction direction;
};

void check(const DropCommandOptions& options) {
  check_outputs(options.common, {{{"--output", options.output, OutputKind::mesh},
                                  {"--map", options.map},
                                  {"--picture", options.picture, OutputKind::picture}},
                                 {{"the object of --onto", options.onto}}});
  refuse_option(options.common.model == "-" && options.onto == "-", "--onto",
                "and MODEL cannot both be standard input");
  const bool best = options.place == PlaceChoice::best;
  refuse_option(options.goal && !best, "--least", "needs --place best");
  refuse_option(options.overlap && options.goal != PlaceGoal::gap, "--overlap", "needs --least gap");
  refuse_option(options.turn && !best, "--turn", "needs --place best");
  refuse_option(options.eps && !best, "--eps", "needs --place best");
  refuse_option(options.max_cells && !best, "--max-cells", "needs --place best");
  refuse_option(!options.region.empty() && !best && !options.needs_map(), "--corner",
                "limits the places of --place best, of --map and of --picture");
  refuse_option(!options.region.empty() && options.region.size() < 3, "--corner",
                "is given three times at least, for a polygon");
  refuse_option(options.step && !options.needs_map(), "--step", "needs --map or --picture");
  if (options.picture) require_rendering();
}

PlaceOptions place_options(const DropCommandOptions& options, const Scene& scene) {
  PlaceOptions place;
  place.semantics = options.semantics;
  place.goal = options.goal.value_or(PlaceGoal::height);
  if (options.overlap) place.min_overlap = *options.overlap;
  place.region = options.region;
  place.turn = options.turn;
  if (options.max_cells)
    place.max_cells = *options.max_cells;
  else if (place.goal != PlaceGoal::height)
    place.max_cells = default_gap_cells;
  const double extent = std::max(HullSupport(scene.item.shape).extent(scene.direction),
                                 HullSupport(scene.base.shape).extent(scene.direction));
  const double share = place.goal == PlaceGoal::height ? tolerance::place_height : tolerance::place_gap;
  place.accuracy = options.eps ? options.eps->in(scene.item.shape.unit) : share * extent;
  if (!(place.accuracy > 0)) throw UsageError("--eps is needed: both shapes are flat along the direction");
  return place;
}

Json place_json(const Place& place) {
  return {{"x", place.x}, {"y", place.y}, {"yaw_degrees", place.yaw_degrees}};
}

void add_drop(Json& document, const Scene& scene, const Drop& drop) {
  document["place"] = place_json(drop.place);
  document["given_place"] = place_json(given_place(scene.item.shape, scene.direction));
  document["height"] = drop.height;
  document["on_floor"] = drop.on_floor;
  document["lift"] = drop.lift_length;
  document["exact_lift"] = to_json(drop.lift);
  document["rotation"] = to_json(drop.transform.rotation);
  const Eigen::Vector3d lifted =
      drop.transform.translation + drop.lift.to_double() * scene.direction.vector();
  document["translation"] = to_json(lifted);
  document["witness"] = drop.on_floor ? Json(nullptr) : to_json(drop.separation.witness);
}

/// The best place, with the options that it was searched with.
struct Choice {
  PlaceOptions options;
  BestPlace best;

  /// Returns the range of the space below MODEL, model units cubed.
  Range volume() const {
    return {best.value.low * best.footprint.low, best.value.high * best.footprint.high};
  }
};

Json range_json(const Range& range) {
  return {{"low", range.low}, {"high", range.high}};
}

void add_proof(Json& document, const std::optional<Choice>& choice) {
  if (!choice) return;
  const BestPlace& best = choice->best;
  const PlaceGoal goal = choice->options.goal;
  document["least"] = choice_name(goals, goal);
  if (goal == PlaceGoal::gap) document["mean_gap"] = range_json(best.value);
  if (goal == PlaceGoal::gap) document["min_overlap"] = choice->options.min_overlap;
  if (goal == PlaceGoal::volume) {
    document["mean_depth"] = range_json(best.value);
    document["footprint"] = range_json(best.footprint);
    document["volume"] = range_json(choice->volume());
  }
  document["bound"] = best.bound;
  document["eps"] = choice->options.accuracy;
  document["proven"] = best.proven;
  document["cells"] = best.cells;
  document["open_cells"] = best.open;
}

void add_choice_lines(TextTable& table, const std::optional<Choice>& choice, Unit unit) {
  if (!choice) return;
  const BestPlace& best = choice->best;
  const auto range_text = [unit](const Range& range, int power) {
    return quantity(range.low, unit, power) + " to " + quantity(range.high, unit, power);
  };
  std::string less = "nowhere lower";
  if (choice->options.goal == PlaceGoal::gap) {
    table.add("Mean gap", range_text(best.value, 1), "where one lies above the other");
    less = "nowhere a smaller mean gap";
  }
  if (choice->options.goal == PlaceGoal::volume) {
    table.add("Space below", range_text(choice->volume(), 3),
              "on average " + range_text(best.value, 1) + " deep");
    less = "nowhere less deep on average";
  }
  table.add(best.proven ? "Proven" : "Bound", quantity(best.bound, unit),
            less + (best.proven ? " than this; " : ", but not as close as asked for; ") +
                counted(best.cells, "cell") + " of places examined, " + std::to_string(best.open) +
                " left open");
}

std::string drop_text(const Scene& scene, const Drop& drop, const std::optional<Choice>& choice) {
  const Unit unit = scene.item.shape.unit;
  TextTable table;
  add_model_line(table, scene.item);
  table.add("Onto", display_name(scene.base) + ": " + brief(scene.base.findings));
  table.add("Height", quantity(drop.height, unit),
            drop.on_floor ? "of its lowest point above the floor: it stands there"
                          : "of its lowest point above that of what it rests on");
  add_choice_lines(table, choice, unit);
  table.add(
      "Place", quantity(drop.place.x, unit) + ", " + quantity(drop.place.y, unit),
      "centre of its box across the direction" +
          (drop.place.yaw_degrees != 0 ? ", turned by " + exact_digits(drop.place.yaw_degrees) + " degrees"
                                       : std::string()));
  table.add("Lift", quantity(drop.lift_length, unit), "from where its file puts it");
  if (!drop.on_floor) {
    const Witness& witness = drop.separation.witness;
    const double size = HullSupport(scene.base.shape).extent(scene.direction);
    table.add("Touching", "triangle " + std::to_string(witness.upper_triangle),
              "of " + title_of(scene.base) + " at " + point_text(witness.upper_point, size));
    table.add("", "triangle " + std::to_string(witness.lower_triangle), "of " + title_of(scene.item));
  }
  return table.text();
}

std::vector<std::string> picture_notes(const Scene& scene, const Drop& drop,
                                       const std::optional<Choice>& choice) {
  const Unit unit = scene.item.shape.unit;
  const bool lowest = choice && choice->options.goal == PlaceGoal::height;
  return {"lowest point " + quantity(drop.height, unit) + " above " +
          (drop.on_floor ? "the floor, where it stands" : "that of what it rests on") +
          (lowest ? "; nowhere lower than " + quantity(choice->best.bound, unit) : std::string())};
}

std::string csv_text(const DropMap& map) {
  std::string text = "x,y,height\n";
  for (std::size_t k = 0; k < map.heights.size(); ++k)
    text += exact_digits(map.x[k % map.x.size()]) + "," + exact_digits(map.y[k / map.x.size()]) + "," +
            exact_digits(map.heights[k]) + "\n";
  return text;
}

/// The map of `--map` and of the picture, with the turn of the place that was chosen.
DropMap map_of(const DropCommandOptions& options, const Scene& scene, const PlaceOptions& place,
               const Drop& drop) {
  double step = length_in(options.step, scene.item.shape.unit);
  if (!options.step) {
    const Frame frame = frame_of(scene.direction);
    const double width = range_along(scene.base.shape, frame.u).length();
    const double depth = range_along(scene.base.shape, frame.v).length();
    step = std::max(width, depth) / default_map_places;
  }
  return with_progress("Mapping", options.common.caller, place, [&](const PlaceOptions& mapping) {
    return drop_map(scene.base.shape, scene.item.shape, scene.direction, step, drop.place.yaw_degrees,
                    mapping);
  });
}

BestPlace searched(const DropCommandOptions& options, const Scene& scene, const PlaceOptions& place) {
  try {
    return with_progress("Placing", options.common.caller, place, [&](const PlaceOptions& searching) {
      return best_place(scene.base.shape, scene.item.shape, scene.direction, searching);
    });
  } catch (const InputError& error) {
    throw InputError(display_name(scene.item) + ": " + error.what());
  }
}

int run_drop_command(const CLI::App& command, const DropCommandOptions& options) {
  const Stopwatch watch;
  check(options);
  const Direction direction(options.direction.value_or(Eigen::Vector3d::UnitZ()));
  const ThreadLimit limit(options.common);
  const Scene scene{load_model(options.common), load_other_model(options.common, options.onto), direction};
  check_same_unit(scene.item, scene.base, "--onto");
  const PlaceOptions place = place_options(options, scene);
  std::optional<Choice> choice;
  if (options.place == PlaceChoice::best) choice = {place, searched(options, scene, place)};
  const Drop drop = choice ? choice->best.drop
                           : drop_at(scene.base.shape, scene.item.shape, direction,
                                     given_place(scene.item.shape, direction), options.semantics);
  const RigidTransform lift{Eigen::Matrix3d::Identity(), drop.lift.to_double() * direction.vector()};
  const Shape dropped = transformed(scene.item.shape, composed(lift, drop.transform));
  if (options.needs_map()) {
    DropMap map = map_of(options, scene, place, drop);
    if (options.map) write_text_output(options.common, *options.map, csv_text(map));
    if (options.picture)
      write_drop_picture({*options.picture, title_of(scene.item) + " on " + title_of(scene.base)},
                         {scene.base.shape, dropped, drop.place, std::move(map), direction,
                          picture_notes(scene, drop, choice)});
  }
  if (options.output)
    write_mesh_output(options.common, *options.output, concatenate(scene.base.shape, dropped));
  Json document = document_head(command, scene.item);
  document["onto"] = scene.base.name;
  document["direction"] = to_json(direction.vector());
  document["semantics"] = name_of(options.semantics);
  add_drop(document, scene, drop);
  add_proof(document, choice);
  add_document_tail(document, options.common, scene.item, watch);
  const std::string text =
      options.common.quiet ? exact_digits(drop.height) + "\n" : drop_text(scene, drop, choice);
  deliver(options.common, document, options.map == "-" ? "" : text);
  return choice && !choice->best.proven ? status_no : status_done;
}

void add_region(CLI::App& command, std::vector<Eigen::Vector2d>& region) {
  const auto take = [&region](const std::vector<std::string>& words) {
    region.clear();
    for (std::size_t i = 0; i + 1 < words.size(); i += 2)
      region.emplace_back(parse_number("--corner", words[i]), parse_number("--corner", words[i + 1]));
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--corner", take,
          "Corner of a polygon that the centre of MODEL stays in, in order, three or more times")
      ->type_size(2)
      ->expected(-1)
      ->allow_extra_args(false)
      ->type_name("X Y");
}

}  // namespace

Command make_drop_command(CLI::App& program) {
  const auto options = std::make_shared<DropCommandOptions>();
  CLI::App* const command = add_command(
      program, "drop", "Let a shape come down onto another one, at its place or at the lowest one",
      "stackabilize drop bowl.obj --onto crate.obj --place best -o both.obj");
  add_common_options(*command, options->common);
  command->add_option("--onto", options->onto, "Mesh file of the shape that MODEL falls on")
      ->type_name("FILE")
      ->required();
  add_direction(*command, "--direction", options->direction,
                "MODEL comes down against this direction, exact doubles (default: 0 0 1)");
  add_semantics_option(*command, options->semantics);
  const Choices<PlaceChoice> places = {{"given", PlaceChoice::given}, {"best", PlaceChoice::best}};
  add_choice(
      *command, "--place", options->place, places,
      "given: across the direction where its file puts it; best: where it comes to rest lowest, with a "
      "proof (default: given)");
  add_choice(
      *command, "--least", options->goal, goals,
      "What the best place has the least of: its height, the mean gap between the two, or the volume of "
      "the empty space below MODEL (default: height)");
  add_fraction(
      *command, "--overlap", options->overlap,
      "For --least gap: area in which one lies above the other, share of the smaller one's, at least "
      "(default: 0.5)");
  command->add_flag("--turn", options->turn, "It may turn about the direction, too");
  add_region(*command, options->region);
  add_length(*command,
             {"--eps",
              "How close the proof comes to the height, mean gap or mean depth found (default: 1/1024 of the "
              "higher extent, 1/64 for --least gap and volume)",
              true},
             options->eps);
  add_count(
      *command,
      {"--max-cells", "Cells of places to examine at most (default: 200000, 2000 for --least gap and volume)",
       1, max_cells_limit},
      options->max_cells);
  add_mesh_output(*command, options->common, options->output, "both");
  command->add_option("--map", options->map, "Write the height at every place of a grid (CSV; - is stdout)")
      ->type_name("FILE");
  command->add_option("--picture", options->picture, "Draw both, and the heights around (.png or .svg)")
      ->type_name("FILE");
  add_length(*command,
             {"--step", "Distance between places of the map (default: 1/32 of what it falls on)", true},
             options->step);
  return {command, [command, options] { return run_drop_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
