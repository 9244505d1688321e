#pragma once

#include <string>
#include <vector>

#include "apps/common/json.h"
#include "apps/improve/improve_pieces.h"
#include "apps/improve/improve_solution.h"

namespace stackabilization::apps {

/// What is written for one task.
struct ImproveReport {
  const ImproveCommandOptions& options;
  const ImproveTask& task;
  const ImproveRun& run;
  std::vector<SolutionReport> solutions;  ///< best first
  std::optional<SolutionReport> nearest;  ///< without solutions
  std::string pictures_missing;           ///< why there are no pictures; empty: there are
  std::vector<PieceReport> pieces = {};   ///< where it stacks better taken apart
  double pieces_stackability = 0;         ///< S of them all

  /// Is there a solution, and is each of them good?
  bool reached() const;
  /// Why the wish was not met, and what would help; null without a diagnosis, and for a front that is
  /// reached: its diagnosis is of what lies beyond its end.
  const Diagnosis* diagnosis() const;
  /// The solutions, or what came nearest.
  std::vector<const SolutionReport*> shown() const;
};

/// A row of the front: a design, and the solution with its files; none at rest.
struct FrontRow {
  const FrontPoint& point;
  const SolutionReport* solution;
  std::vector<std::string> lines;  ///< what changes; empty at rest
};
/// The rows of the front, that at rest first; none without --front.
std::vector<FrontRow> front_rows(const ImproveReport& report);
/// The front as CSV with a heading: target, stackability, change, f_max, edits, name, words.
std::string front_table(const ImproveReport& report);

/// "Solution 1", "Nearest".
std::string title_of(const SolutionReport& solution);
/// What was asked for, a line each.
std::vector<std::string> wish_lines(const ImproveReport& report);
/// How the search ended, as a clause.
std::string end_text(const ImproveRun& run);

/// The whole of one solution.
Json solution_json(const ImproveReport& report, const SolutionReport& solution);
/// {target, ..., solutions, nearest, diagnosis, search}
void add_improvement(Json& document, const ImproveReport& report);
std::string improvement_text(const ImproveReport& report);

}  // namespace stackabilization::apps
