#include "apps/report/design_words.h"

#include <algorithm>
#include <cmath>

#include "apps/common/text.h"
#include "apps/report/page.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/static_stability.h"

namespace stackabilization::apps {

namespace {

/// Measures of quality that use less than half of their limit are in the JSON only; see `violation`.
constexpr double near_limit = -0.05;

/// A stack that drifts by less than this portion of its height is straight to the eye.
constexpr double seen_drift = 1e-3;

}  // namespace

bool StackHeights::fits() const {
  return !room || after <= *room * (1 + tolerance::relative);
}

std::string saving_text(const StackHeights& stack, Unit unit) {
  const std::string copies = std::to_string(stack.copies) + (stack.copies == 1 ? " copy" : " copies");
  const double saved = 1 - stack.after / stack.before;
  const std::string share = percent(std::abs(saved));
  return copies + ": " + quantity(stack.after, unit) + " high instead of " + quantity(stack.before, unit) +
         ", " + (share == percent(0) ? "about as high" : share + (saved < 0 ? " more" : " less"));
}

std::string lean_text(const Stackability& measured, int copies, Unit unit) {
  const double drift = measured.stack_drift(copies);
  if (!up_of_stack(Direction(measured.direction)) || drift <= seen_drift * measured.stack_height(copies))
    return "";
  return " The stack leans by " + significant_text(measured.lean_degrees(), 2) +
         " degrees: the last copy stands " + quantity(drift, unit) + " beside the first.";
}

std::string headline_text(const Stackability& before, const Stackability& after, const StackHeights& stack,
                          Unit unit) {
  return "Each further copy adds " + quantity(after.f_max, unit) + " instead of " +
         quantity(before.f_max, unit) + ". " + saving_text(stack, unit) + "." +
         lean_text(after, stack.copies, unit);
}

std::vector<std::string> edit_lines(const std::vector<Edit>& edits,
                                    const std::vector<std::string>& part_names) {
  std::vector<std::string> lines;
  for (const Edit& edit : edits) lines.push_back(describe(edit, part_names));
  if (lines.empty()) lines.emplace_back("no edit: the shape as it is");
  return lines;
}

std::string check_text(const Check& check, const Structure& rest) {
  const std::string unit = unit_of(check), note = note_of(check, rest);
  std::string text = name_of(check) + ": " + rounded(check.value);
  if (!unit.empty()) text += " " + unit;
  text += ", asked for " + rounded(check.demanded);
  if (!check.passed) text += ", NOT met";
  return note.empty() ? text : text + " (" + note + ")";
}

std::string check_entry(bool good, const std::string& words) {
  return element(good ? "li" : "li class=\"bad\"", words) + "\n";
}

std::string near_limits(const std::vector<Check>& checks, const Structure& rest) {
  std::string text;
  for (const Check& check : checks)
    if (check.kind == CheckKind::quality && violation(check) > near_limit)
      text += check_entry(check.passed, check_text(check, rest));
  return text.empty() ? "" : element("h3", "Near a limit of quality") + "\n<ul>\n" + text + "</ul>\n";
}

}  // namespace stackabilization::apps
