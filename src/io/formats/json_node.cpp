#include "io/formats/json_node.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/edit_distance.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

using Json = nlohmann::ordered_json;

/// Limit of the nesting. Deeper nesting does not occur in documents of this project and would only cost
/// memory.
constexpr int deepest = 16;

std::string shown(const Json& value) {
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (value.is_object()) return "an object";
  if (value.is_string()) return in_quotes(value.get_ref<const std::string&>());
  return value.dump();
}

}  // namespace

nlohmann::ordered_json parse_json(std::string_view text, const std::string& name) {
  std::vector<std::set<std::string>> keys;
  const auto check = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > deepest)
      throw InputError(name + ": expected a document, found JSON that is nested too deeply");
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw InputError(name + ": the key " + in_quotes(value.get<std::string>()) +
                       " occurs twice in one object");
    return true;
  };
  try {
    return Json::parse(text, check);
  } catch (const Json::parse_error& error) {
    const std::size_t at = std::min(error.byte, text.size());
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at > 0 ? at - 1 : 0), '\n');
    throw InputError(name + ":" + std::to_string(line) + ": expected JSON, found something else at byte " +
                     std::to_string(at));
  } catch (const Json::exception&) {
    throw InputError(name + ": expected JSON, found a number beyond the range of double");
  }
}

JsonNode::JsonNode(const Json& value, const std::string& name, std::string place)
    : value_(&value), name_(&name), place_(std::move(place)) {}

void JsonNode::expect_keys(const std::vector<std::string_view>& keys, std::size_t optional) const {
  if (!value_->is_object()) fail_expected("an object");
  const std::vector<std::string> known(keys.begin(), keys.end());
  for (const auto& [key, value] : value_->items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      fail("there is no key " + in_quotes(key) + " here" + nearest_hint(key, known));
  for (std::size_t k = 0; k + optional < keys.size(); ++k) expect_key(known[k]);
}

void JsonNode::expect_key(const std::string& key) const {
  if (!has(key)) fail("the key '" + key + "' is missing");
}

bool JsonNode::has(std::string_view key) const {
  return value_->contains(std::string(key));
}

JsonNode JsonNode::operator[](std::string_view key) const {
  const std::string name(key);
  expect_key(name);
  return {value_->at(name), *name_, place_ + "/" + name};
}

std::size_t JsonNode::list_size() const {
  if (!value_->is_array()) fail_expected("a list");
  return value_->size();
}

JsonNode JsonNode::operator[](std::size_t row) const {
  return {value_->at(row), *name_, place_ + "/" + std::to_string(row)};
}

void JsonNode::expect_size(std::size_t size) const {
  if (!value_->is_array() || value_->size() != size) fail_expected("a list of " + std::to_string(size));
}

double JsonNode::finite() const {
  if (!value_->is_number() || !std::isfinite(value_->get<double>())) fail_expected("a finite number");
  return value_->get<double>();
}

double JsonNode::number() const {
  if (!value_->is_number()) fail_expected("a number");
  if (!(std::abs(value_->get<double>()) <= tolerance::max_coordinate))
    fail_expected("a number of magnitude at most 1e60");
  return value_->get<double>();
}

std::int64_t JsonNode::integer(std::int64_t low, std::int64_t high) const {
  const bool fits =
      value_->is_number_integer() && (!value_->is_number_unsigned() ||
                                      value_->get<std::uint64_t>() <= static_cast<std::uint64_t>(INT64_MAX));
  if (!fits || value_->get<std::int64_t>() < low || value_->get<std::int64_t>() > high)
    fail_expected("an integer from " + std::to_string(low) + " to " + std::to_string(high));
  return value_->get<std::int64_t>();
}

bool JsonNode::boolean() const {
  if (!value_->is_boolean()) fail_expected("true or false");
  return value_->get<bool>();
}

std::string JsonNode::text() const {
  if (!value_->is_string()) fail_expected("a text in quotes");
  return value_->get<std::string>();
}

std::size_t JsonNode::one_of(const std::vector<std::string>& names) const {
  const std::string found = text();
  const auto place = std::find(names.begin(), names.end(), found);
  if (place != names.end()) return static_cast<std::size_t>(place - names.begin());
  constexpr std::size_t max_listed = 8;
  std::string all;
  for (std::size_t k = 0; k < names.size() && names.size() <= max_listed; ++k)
    all += (k == 0 ? "" : k + 1 < names.size() ? ", " : " or ") + in_quotes(names[k]);
  fail("expected " + (all.empty() ? "the name of a part" : all) + ", found " + in_quotes(found) +
       nearest_hint(found, names));
}

Eigen::VectorXd JsonNode::numbers(std::size_t size) const {
  if (!value_->is_array() || value_->size() != size) fail_expected(std::to_string(size) + " numbers");
  Eigen::VectorXd result(static_cast<Eigen::Index>(size));
  for (std::size_t k = 0; k < size; ++k) result(static_cast<Eigen::Index>(k)) = (*this)[k].number();
  return result;
}

Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> JsonNode::table(
    std::size_t columns, std::size_t least) const {
  if (!value_->is_array() || value_->size() < least)
    fail_expected("a list of at least " + std::to_string(least) + " times " + std::to_string(columns) +
                  " numbers");
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(
      static_cast<Eigen::Index>(value_->size()), static_cast<Eigen::Index>(columns));
  for (std::size_t k = 0; k < value_->size(); ++k)
    rows.row(static_cast<Eigen::Index>(k)) = (*this)[k].numbers(columns).transpose();
  return rows;
}

void JsonNode::fail(const std::string& message) const {
  throw InputError(*name_ + ": " + (place_.empty() ? "/" : place_) + ": " + message);
}

void JsonNode::fail_expected(const std::string& what) const {
  fail("expected " + what + ", found " + shown(*value_));
}

std::string nearest_hint(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t longest = 64;  // of words worth comparing
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 2) + 1;
  if (word.size() > longest) return "";
  for (const std::string& name : names) {
    if (name.size() > longest) continue;
    const std::size_t apart = edit_distance(word, name);
    if (apart >= least) continue;
    least = apart;
    best = name;
  }
  return best.empty() ? "" : ", did you mean " + in_quotes(best) + "?";
}

}  // namespace stackabilization::detail
