#pragma once

#include <algorithm>
#include <string>

#include "stackabilization/stacking/validation.h"
#include "support/catch.h"

namespace stackabilization {

/// The row of this name, if there is one.
inline const ValidationRow* find_row(const ValidationReport& report, const std::string& name) {
  const auto found = std::find_if(report.rows.begin(), report.rows.end(),
                                  [&](const ValidationRow& row) { return row.name == name; });
  return found == report.rows.end() ? nullptr : &*found;
}

/// The row of this name, which has to be there.
inline const ValidationRow& row_of(const ValidationReport& report, const std::string& name) {
  const ValidationRow* found = find_row(report, name);
  INFO("row " << name);
  REQUIRE(found != nullptr);
  return *found;
}

}  // namespace stackabilization
