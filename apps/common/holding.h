#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/json.h"
#include "apps/common/text.h"
#include "stackabilization/stacking/seating.h"
#include "stackabilization/stacking/static_stability.h"

/// How a straight stack of copies holds together, for the reports of several commands.
namespace stackabilization::apps {

/// Friction of painted wood, plastic and glazed ceramics on themselves is about that, or more.
inline constexpr double default_friction = 0.3;

/// What is asked.
struct HoldingOptions {
  int copies = 2;                      ///< >= 2
  double friction = default_friction;  ///< coefficient, >= 0
  ContactSemantics semantics = ContactSemantics::solid;
  std::optional<double> side_gap;  ///< of tight walls, model units
};

/// How a stack holds, with gravity along -z, or along -r where the object lies in its stack (up_of_stack).
struct Holding {
  HoldingOptions options;
  StaticStability stability;
  double needed_friction = 0;  ///< see stackabilization::needed_friction
  Seating seating;
  double lean_degrees = 0;  ///< angle between the direction and up
  double drift = 0;         ///< how far the last copy stands beside the first, model units
};

/// Throws as `static_stability` and `seating`.
Holding holding_of(const Shape& shape, const Direction& direction, const HoldingOptions& options);

/// Everything of a holding but the contacts.
Json to_json(const Holding& holding, const std::vector<std::string>& part_names);

/// Adds the lines of a holding.
void add_holding_lines(TextTable& table, const Holding& holding, const std::vector<std::string>& part_names,
                       Unit unit);

/// Says in one or two sentences how a stack holds.
std::string holding_text(const Holding& holding, const std::vector<std::string>& part_names);

}  // namespace stackabilization::apps
