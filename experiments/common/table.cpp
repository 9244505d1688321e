#include "common/table.h"

#include <algorithm>
#include <cmath>

#include "common/json.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"

namespace stackabilization::experiments {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

std::string line(const std::vector<std::string>& cells) {
  std::string text;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) text += ',';
    text += cell;
  }
  return text += '\n';
}

struct CsvCell {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(bool truth) const { return truth ? "1" : "0"; }
  std::string operator()(std::int64_t number) const { return std::to_string(number); }
  std::string operator()(double number) const {
    if (!std::isfinite(number)) return {};
    std::string text;
    append_number(text, number);  // all bits, the sign of zero too
    return text;
  }
  std::string operator()(const std::string& text) const { return quoted(text); }
};

struct JsonCell {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(double number) const { return std::isfinite(number) ? Json(number) : Json(nullptr); }
  template <class Plain>
  Json operator()(const Plain& plain) const {
    return plain;
  }
};

Json json_of(const Provenance& provenance) {
  Json object = Json::object();
  for (const auto& [key, value] : entries(provenance)) object[key] = value;
  return object;
}

}  // namespace

std::vector<Column> columns(const std::vector<std::string>& names, ColumnKind kind) {
  std::vector<Column> result;
  for (const std::string& name : names) result.push_back({name, kind});
  return result;
}

void Table::add(std::vector<Cell> row) {
  if (row.size() != columns_.size())
    throw UsageError("a row of " + std::to_string(row.size()) + " cells does not fit a table of " +
                     std::to_string(columns_.size()) + " columns");
  rows_.push_back(std::move(row));
}

bool Table::has_clocks() const {
  return std::any_of(columns_.begin(), columns_.end(),
                     [](const Column& column) { return column.kind == ColumnKind::clock; });
}

template <class Chosen>
Table Table::chosen(const Chosen& is_chosen) const {
  Table result({});
  for (const Column& column : columns_)
    if (is_chosen(column.kind)) result.columns_.push_back(column);
  for (const std::vector<Cell>& row : rows_) {
    std::vector<Cell> part;
    for (std::size_t c = 0; c < row.size(); ++c)
      if (is_chosen(columns_[c].kind)) part.push_back(row[c]);
    result.rows_.push_back(std::move(part));
  }
  return result;
}

Table Table::without_clocks() const {
  return chosen([](ColumnKind kind) { return kind != ColumnKind::clock; });
}

Table Table::clocks() const {
  return chosen([](ColumnKind kind) { return kind != ColumnKind::value; });
}

std::string csv_text(const Table& table, const Provenance& provenance) {
  std::string text;
  for (const auto& [key, value] : entries(provenance))
    text.append("# ").append(key).append(": ").append(value).append("\n");
  std::vector<std::string> cells;
  for (const Column& column : table.columns()) cells.push_back(quoted(column.name));
  text += line(cells);
  for (const std::vector<Cell>& row : table.rows()) {
    cells.clear();
    for (const Cell& cell : row) cells.push_back(std::visit(CsvCell(), cell));
    text += line(cells);
  }
  return text;
}

std::string json_text(const Table& table, const Provenance& provenance) {
  Json document;
  document["provenance"] = json_of(provenance);
  for (const Column& column : table.columns()) document["columns"].push_back(column.name);
  document["rows"] = Json::array();
  for (const std::vector<Cell>& row : table.rows()) {
    Json object = Json::object();
    for (std::size_t c = 0; c < row.size(); ++c)
      object[table.columns()[c].name] = std::visit(JsonCell(), row[c]);
    document["rows"].push_back(std::move(object));
  }
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace stackabilization::experiments
