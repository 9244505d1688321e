#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "apps/common/common_options.h"
#include "apps/common/values.h"
#include "stackabilization/stacking/stack.h"

namespace stackabilization::apps {

/// Options of `stackabilize stack` as typed; what is left out keeps its default.
struct StackCommandOptions {
  CommonOptions common;
  StackabilityOptions stackability;
  std::optional<int> copies;        ///< -n; default 2
  bool as_many_as_fit = false;      ///< -n max: as many as --within holds
  std::optional<std::string> into;  ///< container that MODEL is lowered into
  std::optional<Eigen::Vector3d> direction;
  std::optional<double> twist_degrees;  ///< a fixed twist
  bool best_twist = false;              ///< --twist-degrees auto
  std::optional<int> period;
  bool best_place = false;  ///< --place best
  bool turn = false;        ///< with it: copies may turn, too
  std::optional<Length> max_shift;
  std::optional<Length> clearance, lateral_clearance, within;
  std::optional<Length> layer;        ///< thickness of the layers of a print
  bool separators = false;            ///< fill the gaps
  std::optional<std::string> output;  ///< mesh file
  std::optional<std::string> picture;

  Direction stacking_direction() const { return Direction(direction.value_or(Eigen::Vector3d::UnitZ())); }
  int copy_count() const { return copies.value_or(2); }
};

/// Throws UsageError when options contradict each other.
void check(const StackCommandOptions& options);
/// Throws UsageError when so many copies cannot be drawn, and are to be.
void check_drawn(const StackCommandOptions& options, int copies);

/// Lengths in units of a model, 0 where not given. Throws UsageError when they cannot be converted.
struct Play {
  double clearance = 0, lateral = 0;
};
Play play_of(const StackCommandOptions& options, Unit unit);

/// What the library is asked for, without poses.
StackOptions stack_options(const StackCommandOptions& options, Unit unit);

}  // namespace stackabilization::apps
