#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "stackabilization/core/number_text.h"
#include "stackabilization/core/units.h"
#include "stackabilization/improvement/explanation.h"

namespace stackabilization {

namespace {

using Kind = FormChangeKind;

struct ChangeWords {
  const char *name, *unit;
  const char *more, *less;  ///< words for a ratio above and below 1; null for other changes
};

constexpr const char *degrees = "degrees", *of_height = "of the height", *of_rest = "of rest";

/// In the order of FormChangeKind.
constexpr std::array<ChangeWords, 18> change_words = {{
    {"lean", degrees, nullptr, nullptr},
    {"tilt", degrees, nullptr, nullptr},
    {"turn", degrees, nullptr, nullptr},
    {"rise", of_height, nullptr, nullptr},
    {"shift", of_height, nullptr, nullptr},
    {"size", of_rest, "larger", "smaller"},
    {"girth", of_rest, "wider all round", "narrower all round"},
    {"width", of_rest, "wider", "narrower"},
    {"length", of_rest, "longer", "shorter"},
    {"tallness", of_rest, "taller", "less tall"},
    {"thickness", of_rest, "thicker", "thinner"},
    {"upper-end", of_rest, "thicker", "thinner"},
    {"lower-end", of_rest, "thicker", "thinner"},
    {"one-end", of_rest, "thicker", "thinner"},
    {"rim", of_rest, "wider", "narrower"},
    {"foot", of_rest, "wider", "narrower"},
    {"bend", of_height, nullptr, nullptr},
    {"form", of_height, nullptr, nullptr},
}};

constexpr std::array<const char*, 4> heading_words = {"none", "outwards", "inwards", "sideways"};

const ChangeWords& words_of(Kind kind) {
  return change_words.at(static_cast<std::size_t>(kind));
}

/// Returns a number >= 0 as a person reads it: two significant digits, no digits after the point from 10 on.
std::string read_number(double value) {
  return value >= 10 ? fixed_text(value, 0) : significant_text(value, 2);
}

std::string length_text(double share, const Explanation& explanation) {
  const double amount = std::abs(share);
  if (explanation.unit == Unit::unknown) return read_number(100 * amount) + " % of the height";
  const double length = amount * explanation.height;
  const Unit unit = readable_unit(length, explanation.unit);
  return read_number(convert_length(length, explanation.unit, unit)) + " " + unit_symbol(unit);
}

/// Returns the name of an end that a change is about; empty for the whole part.
std::string end_of(Kind kind, bool plural) {
  const std::string ends = plural ? " ends" : " end";
  switch (kind) {
    case Kind::upper_end:
      return "upper" + ends;
    case Kind::lower_end:
      return "lower" + ends;
    case Kind::one_end:
      return "one end";
    case Kind::rim:
      return plural ? "rims" : "rim";
    case Kind::foot:
      return plural ? "feet" : "foot";
    default:
      return "";
  }
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Returns whether a number that follows the name could be read as its part: "bar 1", "2 bars (3_part3)".
bool ends_in_a_number(const std::string& name) {
  return !name.empty() && (name.back() == ')' || is_digit(name.back()));
}

std::string verb(const std::string& word, bool plural) {
  return plural ? word : word + "s";
}

/// Returns where something is now: "4 cm higher", or "higher by 4 % of the height".
std::string text_of_place(const std::string& where, double share, const Explanation& explanation) {
  const std::string by = length_text(share, explanation);
  return explanation.unit == Unit::unknown ? where + " by " + by : by + " " + where;
}

std::string where_to(Heading heading) {
  if (heading == Heading::outwards) return "further out";
  return heading == Heading::inwards ? "further in" : "to the side";
}

}  // namespace

std::string name_of(FormChangeKind kind) {
  return words_of(kind).name;
}

std::string name_of(Heading heading) {
  return heading_words.at(static_cast<std::size_t>(heading));
}

std::string unit_of(FormChangeKind kind) {
  return words_of(kind).unit;
}

std::string describe(const FormChange& change, const Explanation& explanation, bool plural) {
  const std::string angle = " by " + read_number(std::abs(change.amount)) + " degrees";
  switch (change.kind) {
    case Kind::lean:
      return verb("lean", plural) + " " + name_of(change.heading) + angle;
    case Kind::tilt:
      return verb("tilt", plural) + angle;
    case Kind::turn:
      return verb("turn", plural) + angle;
    case Kind::rise:
      return text_of_place(change.amount > 0 ? "higher" : "lower", change.amount, explanation);
    case Kind::shift:
      return text_of_place(where_to(change.heading), change.amount, explanation);
    case Kind::bend:
      return verb("bend", plural) + " by " + length_text(change.amount, explanation);
    case Kind::form:
      return verb("change", plural) + " form by " + length_text(change.amount, explanation);
    default:
      break;
  }
  const std::string end = end_of(change.kind, plural);
  return (end.empty() ? "" : end + " ") + read_number(100 * std::abs(change.amount)) + " % " +
         (change.amount > 0 ? words_of(change.kind).more : words_of(change.kind).less);
}

std::string describe(const GroupChange& group, const Explanation& explanation) {
  std::string text = group.name;
  const auto is_width = [](const FormChange& change) { return change.kind == Kind::width; };
  const bool two_widths = std::count_if(group.changes.begin(), group.changes.end(), is_width) == 2;
  std::size_t widths = 0;
  for (std::size_t k = 0; k < group.changes.size(); ++k) {
    std::string change = describe(group.changes[k], explanation, group.plural);
    if (two_widths && is_width(group.changes[k])) change += widths++ == 0 ? " one way" : " the other way";
    const bool apart = !end_of(group.changes[k].kind, group.plural).empty() ||
                       (ends_in_a_number(group.name) && is_digit(change.front()));
    text += (k > 0 ? ", " : apart ? ": " : " ") + change;
  }
  if (!group.followers.empty())
    text += " (" + group.followers_name + (group.followers.size() > 1 ? " follow)" : " follows)");
  for (std::size_t k = 0; k < group.cleared.size(); ++k)
    text += (k == 0 ? ", to clear " : " and ") + group.cleared[k];
  return text;
}

std::vector<std::string> lines(const Explanation& explanation, std::size_t max_lines) {
  const std::vector<GroupChange>& groups = explanation.groups;
  std::vector<std::string> result;
  const std::size_t shown = groups.size() <= max_lines ? groups.size() : max_lines - 1;
  for (std::size_t k = 0; k < shown; ++k) result.push_back(describe(groups[k], explanation));
  if (shown == groups.size()) return result;
  std::size_t parts = 0;
  double largest = 0;
  for (std::size_t k = shown; k < groups.size(); ++k) {
    parts += groups[k].parts.size() + groups[k].followers.size();
    largest = std::max(largest, groups[k].displacement * explanation.diagonal / explanation.height);
  }
  const double bound = std::floor(100 * largest) + 1;
  result.push_back("and " + std::to_string(parts) + (parts == 1 ? " more part" : " more parts") +
                   " by less than " + fixed_text(bound, 0) + " % of the height");
  return result;
}

}  // namespace stackabilization
