#include "apps/common/values.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "apps/common/text.h"
#include "stackabilization/core/direction.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/core/units.h"

namespace stackabilization::apps {

namespace {

/// The number that `text` begins with and what follows it.
struct Leading {
  double value = 0;
  std::string rest;
  bool valid = false;
};

Leading leading_number(const std::string& text) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (text.starts_with('+') && !text.starts_with("+-")) ++begin;
  Leading leading;
  const auto [stop, error] = std::from_chars(begin, end, leading.value);
  leading.valid = error == std::errc() && std::isfinite(leading.value);
  leading.rest.assign(stop, end);
  return leading;
}

/// The number that is all of `text`.
std::optional<double> finite_number(const std::string& text) {
  const Leading leading = leading_number(text);
  return leading.valid && leading.rest.empty() ? std::optional(leading.value) : std::nullopt;
}

}  // namespace

double parse_number(const std::string& option, const std::string& text) {
  const std::optional<double> number = finite_number(text);
  if (!number) throw UsageError(option + " expects a finite number, found '" + text + "'");
  return *number;
}

double parse_number(const Number& number, const std::string& text) {
  const double value = parse_number(number.name, text);
  const bool above = number.open_min ? value > number.min : value >= number.min;
  const bool below = number.open_max ? value < number.max : value <= number.max;
  if (above && below) return value;
  std::string range;
  if (number.min > std::numeric_limits<double>::lowest())
    range = (number.open_min ? " above " : " from ") + exact_digits(number.min);
  if (number.max < std::numeric_limits<double>::max()) {
    const bool both = !range.empty(), closed = both && !number.open_min && !number.open_max;
    range += both && !closed ? " and" : "";
    range += number.open_max ? " below " : closed ? " to " : " up to ";
    range += exact_digits(number.max);
  }
  throw UsageError(number.name + " expects a number" + range + ", found " + text);
}

double parse_fraction(const std::string& option, const std::string& text) {
  constexpr double hundred = 100;
  const Leading leading = leading_number(text);
  const bool is_percentage = leading.rest == "%";
  const double value = is_percentage ? leading.value / hundred : leading.value;
  if (!leading.valid || !(leading.rest.empty() || is_percentage) || !(value >= 0 && value <= 1))
    throw UsageError(option + " expects a fraction from 0 to 1 or a percentage such as 5%, found '" + text +
                     "'");
  return value;
}

namespace {

/// Three of `texts`, from the one at `first` on.
Eigen::Vector3d parse_point(const std::string& option, const std::vector<std::string>& texts,
                            std::size_t first) {
  Eigen::Vector3d point;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> number = finite_number(texts.at(first + i));
    if (!number)
      throw UsageError(option + " expects three finite numbers, such as 0 0 1, found '" + texts[first + i] +
                       "'");
    point[static_cast<Eigen::Index>(i)] = *number;
  }
  return point;
}

/// The same, such as a Direction takes.
Eigen::Vector3d parse_vector(const std::string& option, const std::vector<std::string>& texts,
                             std::size_t first) {
  const Eigen::Vector3d vector = parse_point(option, texts, first);
  if (vector.isZero(0)) throw UsageError(option + " expects a vector that is not zero");
  try {
    return Direction(vector).vector();
  } catch (const UsageError& error) {
    throw UsageError(option + ": " + error.what());
  }
}

/// An option with three values, any number of times; `parse` makes one vector of them.
template <class Parse>
void add_triples(CLI::App& command, const std::string& name, std::vector<Eigen::Vector3d>& target,
                 const std::string& description, const Parse& parse) {
  const auto take = [name, &target, parse](const std::vector<std::string>& texts) {
    target.clear();
    for (std::size_t i = 0; i + 2 < texts.size(); i += 3) target.push_back(parse(name, texts, i));
  };
  command.add_option_function<std::vector<std::string>>(name, take, description)
      ->type_size(3)
      ->expected(-1)
      ->allow_extra_args(false)
      ->type_name("X Y Z");
}

}  // namespace

std::uint64_t parse_count(const Count& count, const std::string& text) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value < count.least || value > count.most)
    throw UsageError(count.name + " expects a whole number from " + std::to_string(count.least) + " to " +
                     std::to_string(count.most) + ", found '" + text + "'");
  return value;
}

const Choices<Unit>& unit_choices() {
  static const Choices<Unit> units = {{"mm", Unit::millimetre}, {"cm", Unit::centimetre},
                                      {"m", Unit::metre},       {"in", Unit::inch},
                                      {"ft", Unit::foot},       {"um", Unit::micrometre}};
  return units;
}

const Choices<Axis>& axis_choices() {
  static const Choices<Axis> axes = {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}};
  return axes;
}

std::optional<Unit> unit_of_symbol(const std::string& symbol) {
  for (const auto& [name, unit] : unit_choices())
    if (name == symbol) return unit;
  return std::nullopt;
}

double length_in(const std::optional<Length>& length, Unit model_unit) {
  return length ? length->in(model_unit) : 0;
}

Length parse_length(const LengthOption& option, const std::string& text) {
  const Leading leading = leading_number(text);
  const std::optional<Unit> unit = leading.rest.empty() ? Unit::unknown : unit_of_symbol(leading.rest);
  if (!leading.valid || !unit)
    throw UsageError(option.name +
                     " expects a length such as 0.5 (model units) or 5mm (um, mm, cm, m, in, ft), found '" +
                     text + "'");
  if (leading.value < 0 || (option.above_zero && leading.value == 0))
    throw UsageError(option.name + " expects a length " +
                     (option.above_zero ? "above 0" : "that is not negative") + ", found " + text);
  if (leading.value > tolerance::max_coordinate)
    throw UsageError(option.name + " expects a length of at most 1e60, found " + text);
  return {leading.value, *unit, text};
}

double Length::in(Unit model_unit) const {
  if (unit == Unit::unknown || unit == model_unit) return value;
  if (model_unit == Unit::unknown)
    throw UsageError("the length " + text + " has a unit but the model has none: say which with --unit");
  const double converted = convert_length(value, unit, model_unit);
  if (converted > tolerance::max_coordinate)
    throw UsageError("the length " + text + " is more than 1e60 in the unit of the model");
  return converted;
}

void add_number(CLI::App& command, const Number& number, std::optional<double>& target) {
  const auto take = [number, &target](const std::string& text) { target = parse_number(number, text); };
  command.add_option_function<std::string>(number.name, take, number.description)->type_name("NUMBER");
}

void add_fraction(CLI::App& command, const std::string& name, std::optional<double>& target,
                  const std::string& description) {
  const auto take = [name, &target](const std::string& text) { target = parse_fraction(name, text); };
  command.add_option_function<std::string>(name, take, description)->type_name("FRACTION");
}

void add_length(CLI::App& command, const LengthOption& option, std::optional<Length>& target) {
  const auto take = [option, &target](const std::string& text) { target = parse_length(option, text); };
  command.add_option_function<std::string>(option.name, take, option.description)->type_name("LENGTH");
}

void add_direction(CLI::App& command, const std::string& name, std::optional<Eigen::Vector3d>& target,
                   const std::string& description) {
  const auto take = [name, &target](const std::vector<std::string>& texts) {
    target = parse_vector(name, texts, 0);
  };
  command.add_option_function<std::vector<std::string>>(name, take, description)
      ->type_size(3)
      ->expected(1)
      ->allow_extra_args(false)
      ->type_name("X Y Z");
}

void add_directions(CLI::App& command, const std::string& name, std::vector<Eigen::Vector3d>& target,
                    const std::string& description) {
  add_triples(command, name, target, description, parse_vector);
}

void add_points(CLI::App& command, const std::string& name, std::vector<Eigen::Vector3d>& target,
                const std::string& description) {
  add_triples(command, name, target, description, parse_point);
}

void add_parts(CLI::App& command, const std::string& name, std::vector<std::string>& target,
               const std::string& description) {
  command.add_option(name, target, description)->type_size(1)->allow_extra_args(false)->type_name("PART");
}

void refuse_option(bool given, const char* option, const char* reason) {
  if (given) throw UsageError(std::string(option) + " " + reason);
}

}  // namespace stackabilization::apps
