#include "paper_figures/page.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <vector>

#include "paper_figures/run.h"
#include "paper_figures/shown.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/io/read_file.h"

namespace stackabilization::figures {
namespace {

/// A figure that was made, with all that is said about it.
struct Entry {
  Figure figure;
  Prose prose;
  Json numbers;
  std::string picture;  ///< path relative to the page
  std::string seconds;  ///< of the run, or "?"
};

/// Five digits for people, and 0 where only rounding is left; all of them are in the JSON.
std::string value_text(const Json& value) {
  constexpr double rounding = 1e-12;
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number_float()) return value.dump();
  const auto number = value.get<double>();
  return significant_text(std::abs(number) < rounding ? 0 : number, 5);
}

Json read_json(const std::filesystem::path& path) {
  Json json = Json::parse(read_file(path), nullptr, false);
  if (json.is_discarded()) throw InputError(path.string() + ": expected a JSON text");
  return json;
}

std::vector<Entry> entries_of(const PageOptions& options) {
  const std::filesystem::path timings_path = options.figures / "timings.json";
  std::error_code error;
  const Json timings =
      std::filesystem::exists(timings_path, error) ? read_json(timings_path) : Json::object();
  const std::filesystem::path base = std::filesystem::absolute(options.page).parent_path();
  std::vector<Entry> entries;
  for (const Figure& figure : all_figures()) {
    const std::string stem = stem_of(figure.number);
    const std::filesystem::path numbers = options.figures / (stem + ".numbers.json");
    if (!std::filesystem::exists(numbers, error)) continue;
    const std::filesystem::path picture = std::filesystem::absolute(options.figures) / (stem + ".png");
    entries.push_back({figure, read_prose(options.inputs / (stem + ".json"), figure), read_json(numbers),
                       picture.lexically_relative(base).generic_string(),
                       timings.contains(stem) ? value_text(timings[stem]) : "?"});
  }
  if (entries.empty())
    throw InputError("the folder " + options.figures.string() +
                     " holds no figures: make them first, with --all or --figure");
  return entries;
}

std::string agreement_of(const Json& claims) {
  const auto holding = std::count_if(claims.begin(), claims.end(),
                                     [](const Json& claim) { return claim.at("holds").get<bool>(); });
  const std::string all = std::to_string(claims.size());
  return std::to_string(holding) + " of " + all + " claims hold";
}

std::string anchor_of(const Entry& entry) {
  return "figure-" + std::to_string(entry.figure.number);
}

std::string summary_table(const std::vector<Entry>& entries) {
  std::string text =
      "| figure | what it is about | made from | time in s | agreement |\n|---|---|---|---|---|\n";
  for (const Entry& entry : entries)
    text += "| [" + std::to_string(entry.figure.number) + "](#" + anchor_of(entry) + ") | " +
            entry.figure.title + " | " +
            (entry.numbers.at("models") == "own" ? "this project's models" : "the authors' models") + " | " +
            entry.seconds + " | " + agreement_of(entry.numbers.at("claims")) + " |\n";
  return text;
}

std::string numbers_table(const Json& numbers) {
  const bool compared = std::any_of(numbers.begin(), numbers.end(),
                                    [](const Json& number) { return number.contains("paper"); });
  std::string text =
      compared ? "| number | ours | paper |\n|---|---|---|\n" : "| number | value |\n|---|---|\n";
  for (const Json& number : numbers) {
    text.append("| ").append(number.at("name").get<std::string>()).append(" | ");
    text += value_text(number.at("value"));
    if (number.contains("unit")) text.append(" ").append(number.at("unit").get<std::string>());
    if (compared) text.append(" | ").append(number.contains("paper") ? value_text(number.at("paper")) : "");
    text += " |\n";
  }
  return text;
}

std::string section(const Entry& entry) {
  const std::string number = std::to_string(entry.figure.number);
  const bool own = entry.numbers.at("models") == "own";
  std::string text = "## Figure " + number;
  text += "\n\n**" + entry.figure.title + "**\n\n![Figure " + number + "](" + entry.picture + ")\n\n";
  text += "*The paper shows:* " + entry.prose.paper + "\n\n";
  text += "*Made by* `paper_figures --figure " + number + " -o out/figures" +
          (own ? "" : " --paper-data FOLDER") + "` in " + entry.seconds + " s.\n\n";
  text += numbers_table(entry.numbers.at("numbers")) + "\n*Agreement:*\n\n";
  for (const Json& claim : entry.numbers.at("claims"))
    text += std::string("* ") + (claim.at("holds").get<bool>() ? "holds: " : "**does not hold**: ") +
            claim.at("says").get<std::string>() + ".\n";
  return text + "\n*Known difference:* " +
         (own ? entry.prose.difference : entry.prose.authors_difference.value_or("")) + "\n";
}

}  // namespace

std::string figures_page(const PageOptions& options) {
  const std::vector<Entry> entries = entries_of(options);
  std::string text =
      "# The figures of the paper\n\n"
      "Written by `paper_figures --page`; do not edit. Each figure is made by one command from one input,\n"
      "`figure_NN.json`, which also holds the words below; `scripts/figures.sh` makes them all. Numbers are\n"
      "rounded here, to 0 below 1e-12; `figure_NN.numbers.json` beside a picture has all digits. S is\n"
      "stackability (Eq. 3); boxes are minimal oriented ones unless said otherwise. Yellow is a shape as\n"
      "given, green one that was improved; blue is the upper envelope, orange the lower one and contact\n"
      "parts, red where copies touch and handles that were moved.\n\n";
  try {
    text += summary_table(entries);
    for (const Entry& entry : entries) text.append("\n").append(section(entry));
  } catch (const Json::exception&) {
    throw InputError("the folder " + options.figures.string() +
                     " holds a damaged .numbers.json: make the figures again");
  }
  return text;
}

}  // namespace stackabilization::figures
