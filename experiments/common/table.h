#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "common/provenance.h"

namespace stackabilization::experiments {

/// What one place of a table holds; std::monostate is an empty place. A real that is not finite is written as
/// an empty place.
using Cell = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

enum class ColumnKind {
  key,    ///< says what the row is about; goes into the file of clocks too
  value,  ///< the same in every run
  clock,  ///< measured time: kept apart, so that everything else is the same in every run
};

struct Column {
  std::string name;
  ColumnKind kind = ColumnKind::value;
};

/// Columns of one kind, for lists: columns({"model", "direction"}, ColumnKind::key).
std::vector<Column> columns(const std::vector<std::string>& names, ColumnKind kind = ColumnKind::value);

/// Rows under named columns.
class Table {
 public:
  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Throws UsageError unless there is one cell per column.
  void add(std::vector<Cell> row);

  const std::vector<Column>& columns() const { return columns_; }
  const std::vector<std::vector<Cell>>& rows() const { return rows_; }
  bool has_clocks() const;

  /// All but the clocks.
  Table without_clocks() const;
  /// Keys and clocks.
  Table clocks() const;

 private:
  template <class Chosen>
  Table chosen(const Chosen& is_chosen) const;

  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// Comment lines with the provenance, a line of names, and one line per row (RFC 4180). Reals read back to
/// the same bits; truth is 1 or 0.
std::string csv_text(const Table& table, const Provenance& provenance);

/// An object with "provenance", "columns" and "rows", a list of objects by column.
std::string json_text(const Table& table, const Provenance& provenance);

}  // namespace stackabilization::experiments
