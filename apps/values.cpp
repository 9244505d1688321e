#include "apps/values.h"

#include <charconv>
#include <cmath>

namespace stackabilization::apps {

namespace {

const Choices<Unit>& unit_symbols() {
  static const Choices<Unit> symbols = {{"um", Unit::micrometre}, {"mm", Unit::millimetre},
                                        {"cm", Unit::centimetre}, {"m", Unit::metre},
                                        {"in", Unit::inch},       {"ft", Unit::foot}};
  return symbols;
}

/// The number that `text` begins with and what follows it.
struct Leading {
  double value = 0;
  std::string rest;
  bool valid = false;
};

Leading leading_number(const std::string& text) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  Leading leading;
  const auto [stop, error] = std::from_chars(begin, end, leading.value);
  leading.valid = error == std::errc() && std::isfinite(leading.value);
  leading.rest.assign(stop, end);
  return leading;
}

}  // namespace

double parse_number(const std::string& option, const std::string& text) {
  const Leading leading = leading_number(text);
  if (!leading.valid || !leading.rest.empty())
    throw UsageError(option + " expects a finite number, found '" + text + "'");
  return leading.value;
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
Eigen::Vector3d parse_vector(const std::string& option, const std::vector<std::string>& texts,
                             std::size_t first) {
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < 3; ++i)
    vector[static_cast<Eigen::Index>(i)] = parse_number(option, texts.at(first + i));
  if (vector.isZero(0)) throw UsageError(option + " expects a vector that is not zero");
  return vector;
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

std::optional<Unit> unit_of_symbol(const std::string& symbol) {
  for (const auto& [name, unit] : unit_symbols())
    if (name == symbol) return unit;
  return std::nullopt;
}

double length_in(const std::string& option, const std::optional<Length>& length, Unit model_unit) {
  if (!length) return 0;
  if (length->value < 0)
    throw UsageError(option + " expects a length that is not negative, found " + length->text);
  return length->in(model_unit);
}

Length parse_length(const std::string& option, const std::string& text) {
  const Leading leading = leading_number(text);
  const std::optional<Unit> unit = leading.rest.empty() ? Unit::unknown : unit_of_symbol(leading.rest);
  if (!leading.valid || !unit)
    throw UsageError(option +
                     " expects a length such as 0.5 (model units) or 5mm (um, mm, cm, m, in, ft), found '" +
                     text + "'");
  return {leading.value, *unit, text};
}

double Length::in(Unit model_unit) const {
  if (unit == Unit::unknown || unit == model_unit) return value;
  if (model_unit == Unit::unknown)
    throw UsageError("the length " + text + " has a unit but the model has none: say which with --unit");
  return value * (metres_per_unit(unit) / metres_per_unit(model_unit));
}

void add_number(CLI::App& command, const std::string& name, std::optional<double>& target,
                const std::string& description) {
  const auto take = [name, &target](const std::string& text) { target = parse_number(name, text); };
  command.add_option_function<std::string>(name, take, description)->type_name("NUMBER");
}

void add_fraction(CLI::App& command, const std::string& name, std::optional<double>& target,
                  const std::string& description) {
  const auto take = [name, &target](const std::string& text) { target = parse_fraction(name, text); };
  command.add_option_function<std::string>(name, take, description)->type_name("FRACTION");
}

void add_length(CLI::App& command, const std::string& name, std::optional<Length>& target,
                const std::string& description) {
  const auto take = [name, &target](const std::string& text) { target = parse_length(name, text); };
  command.add_option_function<std::string>(name, take, description)->type_name("LENGTH");
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
  const auto take = [name, &target](const std::vector<std::string>& texts) {
    target.clear();
    for (std::size_t i = 0; i + 2 < texts.size(); i += 3) target.push_back(parse_vector(name, texts, i));
  };
  command.add_option_function<std::vector<std::string>>(name, take, description)
      ->type_size(3)
      ->expected(-1)
      ->allow_extra_args(false)
      ->type_name("X Y Z");
}

void add_parts(CLI::App& command, const std::string& name, std::vector<std::string>& target,
               const std::string& description) {
  command.add_option(name, target, description)->type_size(1)->allow_extra_args(false)->type_name("PART");
}

}  // namespace stackabilization::apps
