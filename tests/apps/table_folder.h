#pragma once

#include <string>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

namespace stackabilization::apps {

/// A folder with the mesh of a table.
struct TableFolder : TemporaryFolder {
  std::string table = model("table.obj", solids::table({}));
};

/// The same with the project that `structure` makes of it.
struct TableProject : TableFolder {
  std::string project = *this / "table.json";

  TableProject() { REQUIRE(run_program({"structure", table, "--save", project}).status == 0); }
};

}  // namespace stackabilization::apps
