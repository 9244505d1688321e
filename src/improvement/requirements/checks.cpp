#include "stackabilization/improvement/checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/index.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

using detail::at;

struct CheckWords {
  const char *name, *unit;
};

/// In the order of CheckKind.
constexpr std::array<CheckWords, 13> check_words = {{{"target", ""},
                                                     {"room", "model units"},
                                                     {"height", "of the height"},
                                                     {"relations", "of the diagonal"},
                                                     {"proportions", "of the size at rest"},
                                                     {"box", "of a side"},
                                                     {"parts", "of the diagonal"},
                                                     {"thickness", "model units"},
                                                     {"draft", "degrees"},
                                                     {"standing", "degrees"},
                                                     {"jam", "of the force"},
                                                     {"resting", "of the height"},
                                                     {"quality", ""}}};

/// Violation of a measure of quality at twice its limit. S, which other violations are compared with, changes
/// by some tenths.
constexpr double quality_scale = 0.1;

const CheckWords& words_for(CheckKind kind) {
  return check_words.at(static_cast<std::size_t>(kind));
}

/// Returns whether a check demands that its value is at most so large.
bool is_upper_limit(CheckKind kind) {
  return kind == CheckKind::room || kind == CheckKind::height || kind == CheckKind::relations ||
         kind == CheckKind::box || kind == CheckKind::parts || kind == CheckKind::jam;
}

std::string quoted(const Structure& structure, int part) {
  return "'" + structure.parts.at(at(part)).name + "'";
}

/// Returns the sentence of a counted obstacle.
std::string sentence(const Obstacle& obstacle, const Structure& rest) {
  if (const auto* refusal = std::get_if<Refusal>(&obstacle)) return describe(*refusal, rest);
  const Check& check = std::get<Check>(obstacle);
  if (check.kind == CheckKind::quality)
    return "the limit of " + name_of(check.measure) + " would not be kept";
  return "a design that reaches the target fails its check of: " + name_of(check);
}

}  // namespace

std::string name_of(const Check& check) {
  const std::string name = words_for(check.kind).name;
  return check.kind == CheckKind::quality ? name + ": " + name_of(check.measure) : name;
}

std::string unit_of(const Check& check) {
  return check.kind == CheckKind::quality ? unit_of(check.measure) : words_for(check.kind).unit;
}

double violation(const Check& check) {
  if (check.kind == CheckKind::quality) {
    QualityLimits limits;
    limits[check.measure] = check.demanded;
    return quality_scale * (share_of_limit({check.measure, check.value}, limits) - 1);
  }
  const double lack =
      is_upper_limit(check.kind) ? check.value - check.demanded : check.demanded - check.value;
  if (!std::isfinite(lack)) return check.passed ? -1 : 1;
  return check.demanded > 0 ? lack / check.demanded : lack;
}

std::string note_of(const Check& check, const Structure& rest) {
  if (check.where < 0)
    return check.kind == CheckKind::thickness ? "nothing has a thickness"
           : check.kind == CheckKind::standing || check.kind == CheckKind::resting
               ? "copies pass each other along the direction"
               : "";
  if (check.kind == CheckKind::thickness && check.passed) {
    const bool thinner = check.value < check.demanded - tolerance::relative * rest.diagonal;
    return thinner ? "nowhere thinner than at rest" : "";
  }
  switch (check.kind) {
    case CheckKind::relations:
      return describe(rest.relations.at(at(check.where)), rest);
    case CheckKind::box:
      return std::string("along ") + std::string_view("xyz").at(at(check.where));
    case CheckKind::standing:
      return "copy " + std::to_string(check.where + 1) + " of " + std::to_string(check.copies) +
             " goes first";
    default:
      return quoted(rest, check.where) + (check.other < 0 ? "" : " and " + quoted(rest, check.other));
  }
}

std::string describe(const Obstacle& obstacle, const Structure& rest) {
  if (const auto* refusal = std::get_if<Refusal>(&obstacle)) return describe(*refusal, rest);
  const Check& check = std::get<Check>(obstacle);
  const std::string note = note_of(check, rest);
  return "the requirement '" + name_of(check) + "' would not hold" + (note.empty() ? "" : ": " + note);
}

Obstacle without_amounts(const Obstacle& obstacle) {
  if (const auto* refusal = std::get_if<Refusal>(&obstacle)) return without_amounts(*refusal);
  Check check{std::get<Check>(obstacle).kind};
  check.measure = std::get<Check>(obstacle).measure;
  return check;
}

std::string describe(const ObstacleCount& count, const Structure& rest) {
  return sentence(count.obstacle, rest) + " (" + std::to_string(count.count) +
         (count.count == 1 ? " edit)" : " edits)");
}

void sort_by_count(std::vector<ObstacleCount>& counts, const Structure& rest) {
  std::sort(counts.begin(), counts.end(), [&](const ObstacleCount& a, const ObstacleCount& b) {
    if (a.count != b.count) return a.count > b.count;
    return sentence(a.obstacle, rest) < sentence(b.obstacle, rest);
  });
}

}  // namespace stackabilization
