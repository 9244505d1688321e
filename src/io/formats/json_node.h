#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Parses a whole text as JSON. Throws InputError with the line, or with the key that an object contains
/// twice.
nlohmann::ordered_json parse_json(std::string_view text, const std::string& name);

/// A value of a JSON document with its place. All members that check throw InputError "NAME: PLACE: expected
/// WHAT, found VALUE".
class JsonNode {
 public:
  JsonNode(const nlohmann::ordered_json& value, const std::string& name, std::string place = "");

  const std::string& place() const { return place_; }

  /// Checks that the value is an object with these keys and no others. The last `optional` keys may be
  /// missing.
  void expect_keys(const std::vector<std::string_view>& keys, std::size_t optional = 0) const;
  bool has(std::string_view key) const;
  JsonNode operator[](std::string_view key) const;  ///< checks that the key is there

  std::size_t list_size() const;               ///< checks that the value is a list
  JsonNode operator[](std::size_t row) const;  ///< precondition: row < list_size()
  /// Checks that the value is a list of `size` entries.
  void expect_size(std::size_t size) const;

  double finite() const;  ///< checks for a finite number
  double number() const;  ///< checks for a number of magnitude at most tolerance::max_coordinate
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  bool boolean() const;
  std::string text() const;
  /// Returns the row of the value in `names`, and checks that it is one of them.
  std::size_t one_of(const std::vector<std::string>& names) const;
  Eigen::VectorXd numbers(std::size_t size) const;
  /// Returns a list of rows of `columns` numbers, and checks that it has at least `least` rows.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> table(std::size_t columns,
                                                                               std::size_t least) const;

  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_expected(const std::string& what) const;

 private:
  void expect_key(const std::string& key) const;

  const nlohmann::ordered_json* value_;
  const std::string* name_;
  std::string place_;  ///< JSON pointer
};

/// Returns ", did you mean 'X'?" with the entry of `names` nearest to `word`, or nothing when none is near.
std::string nearest_hint(std::string_view word, const std::vector<std::string>& names);

}  // namespace stackabilization::detail
