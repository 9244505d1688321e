#pragma once

#include <CLI/App.hpp>
#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/io/read.h"

/// Values on the command line, checked as soon as they are parsed, so that the rest of the program knows them
/// to be finite and in range. Numbers are read as the nearest doubles, whatever the locale, because
/// directions are exact: "0.3" means that double. All functions throw UsageError in words that name the
/// option.
namespace stackabilization::apps {

/// A finite decimal number, all of `text`.
double parse_number(const std::string& option, const std::string& text);

/// A fraction in [0, 1], as 0.05 or 5%.
double parse_fraction(const std::string& option, const std::string& text);

/// An option that takes a finite number in [min, max], without the ends that are said to be open.
struct Number {
  std::string name, description;
  double min = std::numeric_limits<double>::lowest(), max = std::numeric_limits<double>::max();
  bool open_min = false, open_max = false;
};
double parse_number(const Number& number, const std::string& text);

/// Largest number of cells of a branch and bound that may be asked for: hours of work.
inline constexpr std::uint64_t max_cells_limit = 10000000;

/// Largest angle between two directions, or between a direction and a surface.
inline constexpr double max_degrees = 90;

/// A length as typed: "0.5" in model units, or with a unit, "5mm". From 0 to tolerance::max_coordinate.
struct Length {
  double value = 0;
  Unit unit = Unit::unknown;  ///< unknown: model units
  std::string text;           ///< as typed

  /// In units of a model. Throws UsageError when a unit was typed and the model has none, or the length is
  /// beyond tolerance::max_coordinate in that unit.
  double in(Unit model_unit) const;
};
/// In units of a model, 0 where none was given. Throws UsageError as `in`.
double length_in(const std::optional<Length>& length, Unit model_unit);

/// An option that takes a length.
struct LengthOption {
  std::string name, description;
  bool above_zero = false;  ///< 0 itself is refused too
};
Length parse_length(const LengthOption& option, const std::string& text);

/// An option that takes a whole number.
struct Count {
  std::string name, description;
  std::uint64_t least = 0, most = std::numeric_limits<std::uint64_t>::max();
};
std::uint64_t parse_count(const Count& count, const std::string& text);

/// Copies of a stack: more is a typing error.
inline constexpr int max_copies = 10000;

/// `target` is a whole number or std::optional of one; what it cannot hold is refused.
template <class Target>
void add_count(CLI::App& command, Count count, Target& target) {
  using Value = typename decltype(std::optional(target))::value_type;
  count.most = std::min(count.most, static_cast<std::uint64_t>(std::numeric_limits<Value>::max()));
  const auto take = [count, &target](const std::string& text) {
    target = static_cast<Value>(parse_count(count, text));
  };
  command.add_option_function<std::string>(count.name, take, count.description)->type_name("N");
}

void add_number(CLI::App& command, const Number& number, std::optional<double>& target);
void add_fraction(CLI::App& command, const std::string& name, std::optional<double>& target,
                  const std::string& description);
void add_length(CLI::App& command, const LengthOption& option, std::optional<Length>& target);
/// Three numbers that a Direction takes.
void add_direction(CLI::App& command, const std::string& name, std::optional<Eigen::Vector3d>& target,
                   const std::string& description);

/// The same, any number of times.
void add_directions(CLI::App& command, const std::string& name, std::vector<Eigen::Vector3d>& target,
                    const std::string& description);
/// Three finite numbers, any number of times.
void add_points(CLI::App& command, const std::string& name, std::vector<Eigen::Vector3d>& target,
                const std::string& description);
/// An option with the name of a part, any number of times.
void add_parts(CLI::App& command, const std::string& name, std::vector<std::string>& target,
               const std::string& description);

/// Throws UsageError, the option and then the reason, when an option is given that does not fit the others.
void refuse_option(bool given, const char* option, const char* reason);

/// An option whose values have names.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// Names of the units on the command line: mm, cm, m, in, ft, um.
const Choices<Unit>& unit_choices();
/// The axes of a file, by name.
const Choices<Axis>& axis_choices();
std::optional<Unit> unit_of_symbol(const std::string& symbol);

/// "a|b|c", for the help.
template <class Value>
std::string choice_names(const Choices<Value>& choices) {
  std::string names;
  for (const auto& [name, value] : choices) names += (names.empty() ? "" : "|") + name;
  return names;
}

/// Returns the name of a value, empty where it has none.
template <class Value>
std::string choice_name(const Choices<Value>& choices, Value value) {
  for (const auto& [name, known] : choices)
    if (known == value) return name;
  return {};
}

/// Adds an option that takes one of the names of `choices` into `target` (a Value or std::optional of it).
template <class Value, class Target>
void add_choice(CLI::App& command, const std::string& name, Target& target, const Choices<Value>& choices,
                const std::string& description) {
  const auto take = [name, &target, choices](const std::string& text) {
    for (const auto& [known, value] : choices)
      if (known == text) {
        target = value;
        return;
      }
    throw UsageError(name + " expects one of " + choice_names(choices) + ", found '" + text + "'");
  };
  command.add_option_function<std::string>(name, take, description)->type_name(choice_names(choices));
}

}  // namespace stackabilization::apps
