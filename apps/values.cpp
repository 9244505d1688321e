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

void add_length(CLI::App& command, const std::string& name, std::optional<Length>& target,
                const std::string& description) {
  const auto take = [name, &target](const std::string& text) { target = parse_length(name, text); };
  command.add_option_function<std::string>(name, take, description)->type_name("LENGTH");
}

void add_direction(CLI::App& command, const std::string& name, std::optional<Eigen::Vector3d>& target,
                   const std::string& description) {
  const auto take = [name, &target](const std::vector<std::string>& texts) {
    target.emplace();
    for (int i = 0; i < 3; ++i) (*target)[i] = parse_number(name, texts.at(i));
    if (target->isZero(0)) throw UsageError(name + " expects a vector that is not zero");
  };
  command.add_option_function<std::vector<std::string>>(name, take, description)
      ->type_size(3)
      ->expected(1)
      ->allow_extra_args(false)
      ->type_name("X Y Z");
}

}  // namespace stackabilization::apps
