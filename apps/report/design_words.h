#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/improvement/checks.h"
#include "stackabilization/stacking/stackability.h"

/// What reports and pages say of a design.
namespace stackabilization::apps {

/// Copies on top of each other, before and after.
struct StackHeights {
  int copies = 0;
  double before = 0, after = 0;  ///< model units
  std::optional<double> room;    ///< that was asked for

  bool fits() const;
};

/// "5 copies: 2.1 m high instead of 4.5 m, 53.3 % less"
std::string saving_text(const StackHeights& stack, Unit unit);
/// " The stack leans by 3 degrees: the last copy stands 7 cm beside the first.", of objects that stand in it,
/// with z upwards; empty where it goes straight up.
std::string lean_text(const Stackability& measured, int copies, Unit unit);
/// "Each further copy adds 0.2 m instead of 0.8 m. 5 copies: 1.6 m high instead of 4 m, 60 % less.", and how
/// far a stack leans that does not go straight up.
std::string headline_text(const Stackability& before, const Stackability& after, const StackHeights& stack,
                          Unit unit);
/// What was edited, a line per edit; one line that says so when nothing was.
std::vector<std::string> edit_lines(const std::vector<Edit>& edits,
                                    const std::vector<std::string>& part_names);
/// What the requirement asked and what was found.
std::string check_text(const Check& check, const Structure& rest);

/// An entry of a list of a page, in red unless good.
std::string check_entry(bool good, const std::string& words);
/// The part of a page about measures of quality that come near their limits, or break them; empty where none
/// does.
std::string near_limits(const std::vector<Check>& checks, const Structure& rest);

}  // namespace stackabilization::apps
