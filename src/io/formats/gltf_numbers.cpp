#include "io/formats/gltf_numbers.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

using nlohmann::json;

constexpr std::int64_t max_row = std::numeric_limits<int>::max();
constexpr std::int64_t max_bytes = std::int64_t{1} << 53;
constexpr std::size_t whole = 0;

/// Allowed value at a place: one integer in [min, max], or a list of `list_size` numbers.
struct Rule {
  std::string_view place;  ///< JSON pointer, * for every row of a list
  std::int64_t min = 0, max = max_row;
  std::size_t list_size = whole;
};

constexpr std::array<Rule, 20> rules = {{{"scene"},
                                         {"scenes/*/nodes/*"},
                                         {"nodes/*/mesh"},
                                         {"nodes/*/children/*"},
                                         {"nodes/*/matrix", 0, 0, 16},
                                         {"nodes/*/translation", 0, 0, 3},
                                         {"nodes/*/rotation", 0, 0, 4},
                                         {"nodes/*/scale", 0, 0, 3},
                                         {"meshes/*/primitives/*/attributes/POSITION"},
                                         {"meshes/*/primitives/*/indices"},
                                         {"meshes/*/primitives/*/mode", 0, 6},
                                         {"accessors/*/bufferView"},
                                         {"accessors/*/byteOffset", 0, max_bytes},
                                         {"accessors/*/componentType", 5120, 5126},
                                         {"accessors/*/count", 0, max_row},
                                         {"bufferViews/*/buffer"},
                                         {"bufferViews/*/byteOffset", 0, max_bytes},
                                         {"bufferViews/*/byteLength", 0, max_bytes},
                                         {"bufferViews/*/byteStride", 0, 252},
                                         {"buffers/*/byteLength", 0, max_bytes}}};

std::string found_text(const json& value) {
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (value.is_object()) return "an object";
  if (value.is_string()) return "a text";
  return value.dump();
}

class Checker {
 public:
  explicit Checker(const std::string& name) : name_(name) {}

  void check(const Rule& rule, const json& value, std::string_view rest, const std::string& place) const {
    if (rest.empty()) {
      if (rule.list_size == whole)
        check_whole(rule, value, place);
      else
        check_list(rule, value, place);
      return;
    }
    const std::size_t slash = rest.find('/');
    const std::string key(rest.substr(0, slash));
    const std::string_view next = slash == std::string_view::npos ? "" : rest.substr(slash + 1);
    if (key == "*") {
      for (std::size_t row = 0; value.is_array() && row < value.size(); ++row)
        check(rule, value[row], next, place + "/" + std::to_string(row));
    } else if (value.is_object()) {
      if (const auto found = value.find(key); found != value.end())
        check(rule, *found, next, place + "/" + key);
    }
  }

 private:
  void check_whole(const Rule& rule, const json& value, const std::string& place) const {
    const bool fits = value.is_number_unsigned()
                          ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(rule.max)
                          : value.is_number_integer() && value.get<std::int64_t>() <= rule.max;
    if (!fits || value.get<std::int64_t>() < rule.min)
      fail(place, "a whole number from " + std::to_string(rule.min) + " to " + std::to_string(rule.max),
           value);
  }

  void check_list(const Rule& rule, const json& value, const std::string& place) const {
    if (!value.is_array() || value.size() != rule.list_size)
      fail(place, std::to_string(rule.list_size) + " numbers", value);
    for (std::size_t row = 0; row < value.size(); ++row)
      if (!value[row].is_number() || !(std::abs(value[row].get<double>()) <= tolerance::max_coordinate))
        fail(place + "/" + std::to_string(row), "a number of magnitude at most 1e60", value[row]);
  }

  [[noreturn]] void fail(const std::string& place, const std::string& expected, const json& found) const {
    throw InputError(name_ + ": " + place + ": expected " + expected + ", found " + found_text(found));
  }

  const std::string& name_;
};

}  // namespace

void check_gltf_numbers(std::string_view text, const std::string& name) {
  constexpr bool throwing = false;
  const json document = json::parse(text, nullptr, throwing);
  const Checker checker(name);
  for (const Rule& rule : rules) checker.check(rule, document, rule.place, "");
}

}  // namespace stackabilization
