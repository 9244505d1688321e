#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// The whole text as JSON. Throws InputError naming the line, or the key that an object has twice.
nlohmann::ordered_json parse_json(std::string_view text, const std::string& name);

/// A value of a JSON document and its place. Every demand that is not met throws InputError
/// "NAME: PLACE: expected WHAT, found VALUE".
class JsonNode {
 public:
  JsonNode(const nlohmann::ordered_json& value, const std::string& name, std::string place = "");

  const std::string& place() const { return place_; }

  /// Demands an object, of these keys and no others. All but the last `optional` ones must be there.
  void expect_keys(const std::vector<std::string_view>& keys, std::size_t optional = 0) const;
  bool has(std::string_view key) const;
  JsonNode operator[](std::string_view key) const;  ///< precondition: `has(key)`

  std::size_t list_size() const;               ///< demands a list
  JsonNode operator[](std::size_t row) const;  ///< precondition: row < list_size()
  /// Demands a list of `size` entries.
  void expect_size(std::size_t size) const;

  double finite() const;  ///< demands a finite number
  double number() const;  ///< of magnitude at most tolerance::max_coordinate
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  bool boolean() const;
  std::string text() const;
  /// Row of one of the `names`.
  std::size_t one_of(const std::vector<std::string>& names) const;
  Eigen::VectorXd numbers(std::size_t size) const;
  /// Rows of `columns` numbers, at least `least`.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> table(std::size_t columns,
                                                                               std::size_t least) const;

  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_expected(const std::string& what) const;

 private:
  const nlohmann::ordered_json* value_;
  const std::string* name_;
  std::string place_;  ///< JSON pointer
};

/// ", did you mean 'X'?" with the nearest of `names` to `word`, empty when none is near.
std::string nearest_hint(std::string_view word, const std::vector<std::string>& names);

}  // namespace stackabilization::detail
