#include <set>
#include <string>
#include <vector>

#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/improvement/diagnosis.h"

namespace stackabilization {

namespace {

std::string number(double value, int digits = 3) {
  return fixed_text(value, digits);
}

/// Formats `value` with as many digits as tell it from `other`, 3 to 9.
std::string number_unlike(double value, double other) {
  int digits = 3;
  while (digits < 9 && number(value, digits) == number(other, digits)) ++digits;
  return number(value, digits);
}

std::string names(const std::vector<int>& parts, const Structure& structure) {
  std::string text;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) text += k + 1 < parts.size() ? ", " : " and ";
    text += "'" + structure.parts[static_cast<std::size_t>(parts[k])].name + "'";
  }
  return text;
}

}  // namespace

std::string reason_of(const Blocker& blocker, const Structure& rest) {
  switch (blocker.edits) {
    case Blocker::Edits::untried:
      return "";
    case Blocker::Edits::unfinished:
      return "time was up before every edit that may separate it was tried";
    case Blocker::Edits::none:
      return "no edit would separate it: symmetries and the height that is kept leave none";
    case Blocker::Edits::helpful:
      return "one more edit would give S = " + number(blocker.best_stackability);
    case Blocker::Edits::unhelpful:
      return "edits separate it, but other contacts ask for as much, a limit stands against it, or it takes "
             "more than one";
    case Blocker::Edits::refused:
      return "every edit that would separate it is refused, most because " + describe(blocker.obstacle, rest);
  }
  return "";
}

std::string describe(const Blocker& blocker, const Structure& rest) {
  const std::string above = names({blocker.lower_part}, rest), below = names({blocker.upper_part}, rest),
                    reason = reason_of(blocker, rest);
  const char* how = blocker.type == ContactType::ring   ? " all around"
                    : blocker.type == ContactType::line ? " along a line"
                                                        : "";
  return above + " of each copy comes down on " + below + " of the copy below" + how +
         ". These two alone leave S = " + number(blocker.stackability) +
         (reason.empty() ? "" : ": " + reason) + ".";
}

std::string describe(const Remedy& remedy, const Structure& rest) {
  switch (remedy.kind) {
    case Remedy::Kind::other_direction:
      return "stack " + direction_text(remedy.direction) + ", without any edit";
    case Remedy::Kind::free_part:
      return "let " + names(remedy.parts, rest) + " change";
    case Remedy::Kind::remove_part:
      return "leave out " + names(remedy.parts, rest);
    case Remedy::Kind::take_apart:
      return "take off " + names(remedy.parts, rest) + " and stack the pieces apart";
    case Remedy::Kind::relax_height:
      return "let the height change";
    case Remedy::Kind::relax_box:
      return "let the box change";
    case Remedy::Kind::relax_quality:
      return "--relax " + name_of(remedy.measure);
  }
  return "";
}

std::string text(const Diagnosis& diagnosis, const Structure& rest) {
  const double best = diagnosis.better ? diagnosis.better->measured.value : diagnosis.reached;
  std::string text = "S = " + number(diagnosis.target) +
                     " was not reached; the best is S = " + number_unlike(best, diagnosis.target) + " " +
                     direction_text(diagnosis.direction) + ".\n";
  if (diagnosis.better && !diagnosis.blockers.empty())
    text += "Without its last edit it has S = " + number_unlike(diagnosis.reached, diagnosis.target) +
            ", and this holds it:\n";
  if (diagnosis.closed) text += describe(*diagnosis.closed, rest) + "\n";
  std::set<std::string> told;
  for (const Blocker& blocker : diagnosis.blockers)
    if (const std::string line = describe(blocker, rest); told.insert(line).second) text += line + "\n";
  if (!diagnosis.constraints.empty()) text += "What stood against edits most often:\n";
  for (const ObstacleCount& constraint : diagnosis.constraints)
    text += "  " + describe(constraint, rest) + "\n";
  if (diagnosis.remedies.empty()) return text + "No single change was found that would help.\n";
  text += "What would help:\n";
  for (const Remedy& remedy : diagnosis.remedies)
    text += "  " + describe(remedy, rest) + ": S = " + number(remedy.stackability) + "\n";
  return text;
}

}  // namespace stackabilization
