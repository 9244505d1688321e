#include "apps/common/holding.h"

#include <algorithm>
#include <cmath>

#include "stackabilization/core/number_text.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization::apps {

namespace {

/// Slopes, coefficients and angles that are smaller are none to a person.
constexpr double seen = 5e-4;
constexpr std::size_t listed_walls = 6;
/// Rubber on dry wood has about that.
constexpr double much_friction = 1;
/// Walls that are nearer than this fraction of the root of their area touch.
constexpr double touching = 1e-4;

std::string name_at(const std::vector<std::string>& names, int part) {
  return "'" + names.at(static_cast<std::size_t>(part)) + "'";
}

std::string parts_text(const std::vector<std::string>& names, int lower, int upper) {
  return name_at(names, lower) + (lower == upper ? " on itself" : " on " + name_at(names, upper));
}

std::string copy_text(const Holding& holding) {
  if (holding.stability.weakest_copy == 0) return "the whole stack over its lowest copy";
  const int number = holding.stability.weakest_copy + 1;
  return "copy " + std::to_string(number) + (number < holding.options.copies ? " and those above it" : "");
}

void add_standing_lines(TextTable& table, const Holding& holding) {
  const StaticStability& stack = holding.stability;
  const std::string copies = std::to_string(holding.options.copies) + " copies, friction " +
                             rounded(holding.options.friction) + " between them: ";
  if (stack.stands)
    table.add("Stands", "up to " + degrees_text(stack.tipping_degrees),
              copies + "on ground tilted by more, " + copy_text(holding) + " topples or slides");
  else
    table.add("Stands", "no", copies + copy_text(holding) + " topples or slides on level ground");
  const double needed = holding.needed_friction;
  if (!std::isfinite(needed))
    table.add("Friction", "of no use", "copies topple, however rough they are");
  else if (needed < seen)
    table.add("Friction", "not needed", "to stay on level ground");
  else
    table.add("Friction", rounded(needed),
              needed > much_friction ? "would be needed on level ground, more than most materials have"
                                     : "is needed for copies to stay on level ground");
}

void add_centring_line(TextTable& table, double slope) {
  if (slope > seen)
    table.add("Centres", "itself",
              "a copy that is shifted without tilting slides back where friction is below " + rounded(slope));
  else if (slope < -seen)
    table.add("Centres", "no", "copies slide off their place where friction is below " + rounded(-slope));
  else
    table.add("Centres", "no", "a copy stays where it is put, towards at least one side");
}

void add_jam_lines(TextTable& table, const Holding& holding, const std::vector<std::string>& names,
                   Unit unit) {
  const Seating& seat = holding.seating;
  if (seat.pull_off > 0)
    table.add("Jams", "yes",
              parts_text(names, seat.lower_part, seat.upper_part) + ", draft " +
                  degrees_text(seat.draft_degrees) + ": to pull a copy off takes up to " +
                  percent(seat.pull_off) + " of the force that pressed it on");
  else
    table.add("Jams", seat.walls_pull_off > 0 ? "askew" : "no",
              seat.walls_pull_off > 0
                  ? "by walls that are close to each other: pulled askew, a copy resists up to " +
                        percent(seat.walls_pull_off) + " of the force that presses it against them"
                  : "contacts are at least " + degrees_text(seat.draft_degrees) + " from the direction");
  for (std::size_t k = 0; k < std::min(seat.tight.size(), listed_walls); ++k) {
    const TightWalls& wall = seat.tight[k];
    table.add(
        k == 0 ? "Tight walls" : "", quantity(wall.area, unit, 2),
        parts_text(names, wall.lower_part, wall.upper_part) + ", " +
            (wall.gap < touching * std::sqrt(wall.area) ? "touching"
                                                        : quantity(wall.gap, unit) + " apart at least") +
            ", draft " + degrees_text(wall.draft_degrees));
  }
  if (seat.tight.size() > listed_walls) table.add("", "...", "all of them with --json");
}

Json named_part(const std::vector<std::string>& names, int part) {
  return part < 0 ? Json(nullptr) : Json(names.at(static_cast<std::size_t>(part)));
}

}  // namespace

Holding holding_of(const Shape& shape, const Direction& direction, const HoldingOptions& options) {
  Holding holding;
  holding.options = options;
  StaticStabilityOptions stack;
  stack.copies = options.copies;
  stack.semantics = options.semantics;
  stack.friction = options.friction;
  stack.up = up_of_stack(direction);
  holding.stability = static_stability(shape, direction, stack);
  holding.needed_friction = needed_friction(shape, direction, stack);
  SeatingOptions seat;
  seat.friction = options.friction;
  seat.semantics = options.semantics;
  seat.up = stack.up;
  seat.side_gap = options.side_gap;
  holding.seating = seating(shape, direction, seat);
  StackabilityOptions measure;
  measure.semantics = options.semantics;
  measure.flat_shapes = FlatShapes::measure;
  const Stackability measured = stackability(shape, direction, measure);
  const bool in_place = measured.f_max < tolerance::relative * measured.extent;
  if (stack.up) holding.lean_degrees = measured.lean_degrees();
  if (stack.up && !in_place) holding.drift = measured.stack_drift(options.copies);
  return holding;
}

Json to_json(const Holding& holding, const std::vector<std::string>& part_names) {
  const StaticStability& stack = holding.stability;
  const Seating& seat = holding.seating;
  const double needed = holding.needed_friction;
  Json tight = Json::array();
  for (const TightWalls& wall : seat.tight)
    tight.push_back({{"lower_part", named_part(part_names, wall.lower_part)},
                     {"upper_part", named_part(part_names, wall.upper_part)},
                     {"gap", wall.gap},
                     {"draft_degrees", wall.draft_degrees},
                     {"area", wall.area}});
  return {{"n", holding.options.copies},
          {"friction", holding.options.friction},
          {"lean_degrees", holding.lean_degrees},
          {"drift", holding.drift},
          {"stands", stack.stands},
          {"tipping_degrees", stack.tipping_degrees},
          {"weakest_copy", stack.weakest_copy},
          {"needed_friction", std::isfinite(needed) ? Json(needed) : Json(nullptr)},
          {"centre_of_mass", to_json(stack.centre_of_mass)},
          {"mass_of_solid", stack.of_solid},
          {"centring_slope", seat.centring_slope},
          {"draft_degrees", seat.draft_degrees},
          {"jams", seat.jams()},
          {"pull_off", seat.pull_off},
          {"jammed_lower_part", named_part(part_names, seat.lower_part)},
          {"jammed_upper_part", named_part(part_names, seat.upper_part)},
          {"walls_pull_off", seat.walls_pull_off},
          {"tight_walls", std::move(tight)}};
}

void add_holding_lines(TextTable& table, const Holding& holding, const std::vector<std::string>& part_names,
                       Unit unit) {
  add_standing_lines(table, holding);
  if (holding.lean_degrees > 0)
    table.add("Leans", degrees_text(holding.lean_degrees),
              "the last copy stands " + quantity(holding.drift, unit) + " beside the first");
  add_centring_line(table, holding.seating.centring_slope);
  add_jam_lines(table, holding, part_names, unit);
}

std::string holding_text(const Holding& holding, const std::vector<std::string>& part_names) {
  const StaticStability& stack = holding.stability;
  const Seating& seat = holding.seating;
  std::string text = "With friction " + rounded(holding.options.friction) + " a stack of " +
                     std::to_string(holding.options.copies) +
                     (stack.stands ? " stands on ground tilted by up to " +
                                         significant_text(stack.tipping_degrees, 2) + " degrees"
                                   : " does not stand: " + copy_text(holding) + " topples or slides");
  if (stack.stands && std::abs(seat.centring_slope) > seen)
    text += seat.centring_slope > 0 ? "; copies centre themselves" : "; copies tend to slide off their place";
  if (seat.pull_off > 0)
    text += "; copies jam at " + parts_text(part_names, seat.lower_part, seat.upper_part) +
            ", so that pulling one off takes up to " + percent(seat.pull_off) +
            " of the force that pressed it on";
  else if (seat.walls_pull_off > 0)
    text += "; pulled askew, copies jam at " +
            parts_text(part_names, seat.tight.front().lower_part, seat.tight.front().upper_part);
  return text + ".";
}

}  // namespace stackabilization::apps
