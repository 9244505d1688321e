#include "stackabilization/core/part_names.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "core/edit_distance.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"

namespace stackabilization {

namespace {

constexpr std::size_t max_listed = 12;
/// Number of characters that are compared: a file may have names of any length.
constexpr std::size_t max_compared = 48;

/// Compares without regard to case.
std::size_t distance(const std::string& a, const std::string& b) {
  return edit_distance(lower_case(std::string_view(a).substr(0, max_compared)),
                       lower_case(std::string_view(b).substr(0, max_compared)));
}

/// Returns a name as the user can type it, without characters that would garble a terminal.
std::string quoted(const std::string& name) {
  std::string text = "'";
  for (const char c : name) text += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
  return text + "'";
}

bool is_number(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Returns whether `name` is a `member_name` of `part`.
bool is_member(std::string_view name, std::string_view part) {
  return name.size() > part.size() && name.starts_with(part) && name[part.size()] == '.' &&
         is_number(name.substr(part.size() + 1));
}

/// "part_12": a number that a segmentation gave.
bool is_numbered(const std::string& name) {
  constexpr std::string_view start = "part_";
  return name.starts_with(start) && is_number(std::string_view(name).substr(start.size()));
}

}  // namespace

std::string member_name(const std::string& part, int number) {
  return part + "." + std::to_string(number);
}

std::vector<int> parts_named(const Shape& shape, const std::vector<std::string>& names) {
  const std::vector<std::string>& known = shape.part_names;
  std::vector<int> parts;
  for (const std::string& name : names) {
    const std::size_t before = parts.size();
    for (std::size_t row = 0; row < known.size(); ++row)
      if (known[row] == name || is_member(known[row], name)) parts.push_back(static_cast<int>(row));
    if (parts.size() == before) throw InputError(unknown_part(known, name));
  }
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  return parts;
}

std::string unknown_part(const std::vector<std::string>& part_names, const std::string& name) {
  std::vector<std::pair<std::size_t, std::size_t>> ranked;
  for (std::size_t row = 0; row < part_names.size(); ++row)
    ranked.emplace_back(distance(name, part_names[row]), row);
  std::sort(ranked.begin(), ranked.end());
  const std::size_t listed = std::min(max_listed, ranked.size());
  std::string text = "there is no part " + quoted(name) + ", only ";
  for (std::size_t i = 0; i < listed; ++i) text += (i > 0 ? ", " : "") + quoted(part_names[ranked[i].second]);
  if (listed < ranked.size()) text += " and " + std::to_string(ranked.size() - listed) + " more";
  if (std::all_of(part_names.begin(), part_names.end(), is_numbered))
    text += ": parts without names in the file, which stackabilize structure --picture FILE shows";
  return text;
}

}  // namespace stackabilization
