#include "paper_figures/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <system_error>

#include "stackabilization/core/errors.h"
#include "stackabilization/io/file_plan.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/io/write_file.h"

namespace stackabilization::figures {
namespace {

constexpr const char* timings_name = "timings.json";
constexpr const char* own_block = "own";
constexpr const char* authors_block = "authors";

std::filesystem::path input_of(const RunOptions& options, const Figure& figure) {
  return options.inputs / (stem_of(figure.number) + ".json");
}

Prose prose_of(const Fields& fields) {
  Prose prose{fields.text("paper"), fields.text("difference"), {}};
  if (fields.has(authors_block)) prose.authors_difference = fields.object(authors_block).text("difference");
  return prose;
}

/// The options of a figure in its file, all of which was understood.
PreparedFigure prepare(const std::filesystem::path& input, const Figure& figure, bool authors) {
  const Fields fields = Fields::of_file(input);
  if (fields.whole("figure", 1, 99) != figure.number) fields.refuse("figure", std::to_string(figure.number));
  prose_of(fields);  // has to be there
  PreparedFigure own = figure.prepare(fields.object(own_block));
  PreparedFigure other;
  if (fields.has(authors_block)) other = figure.prepare(fields.object(authors_block));
  fields.refuse_unread();
  if (authors && !other)
    throw UsageError("figure " + std::to_string(figure.number) +
                     " has no input on the authors' models: leave out --paper-data");
  return authors ? other : own;
}

Json json_of(const Figure& figure, const FigureResult& result, const std::string& models) {
  Json numbers = Json::array(), claims = Json::array();
  for (const Number& number : result.numbers) {
    Json entry = {{"name", number.name}, {"value", number.value}};
    if (!number.unit.empty()) entry["unit"] = number.unit;
    if (number.paper) entry["paper"] = *number.paper;
    numbers.push_back(std::move(entry));
  }
  for (const Claim& claim : result.claims) claims.push_back({{"says", claim.says}, {"holds", claim.holds}});
  return {{"figure", figure.number}, {"models", models}, {"numbers", numbers}, {"claims", claims}};
}

/// The seconds of this figure among those of the others that are in the folder already.
void note_time(const std::filesystem::path& folder, const Figure& figure, double seconds) {
  const std::filesystem::path path = folder / timings_name;
  nlohmann::json timings;  // sorted by key
  std::error_code missing;
  if (std::filesystem::exists(path, missing))
    timings = nlohmann::json::parse(read_file(path), nullptr, false);
  if (!timings.is_object()) timings = nlohmann::json::object();
  constexpr double tenths = 10;
  timings[stem_of(figure.number)] = std::round(tenths * seconds) / tenths;
  write_file_atomically(path, timings.dump(2) + "\n");
}

FigureResult make_one(const Figure& figure, const PreparedFigure& prepared, const RunOptions& options) {
  const bool authors = options.paper_data.has_value();
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  FigureResult result = prepared(ModelFolder{authors ? *options.paper_data : options.models});
  const std::string stem = stem_of(figure.number);
  write_drawing(options.output / (stem + ".png"), result.drawing);
  if (result.kind == FigureKind::plot) write_drawing(options.output / (stem + ".svg"), result.drawing);
  write_file_atomically(options.output / (stem + ".numbers.json"),
                        json_of(figure, result, authors ? authors_block : own_block).dump(2) + "\n");
  note_time(options.output, figure, std::chrono::duration<double>(Clock::now() - start).count());
  return result;
}

void require_folder(const std::filesystem::path& folder, const std::string& what) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw InputError("the folder of " + what + ", " + folder.string() + ", does not exist");
}

void prepare_output(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error))
    throw OutputError("the folder " + folder.string() + " cannot be made");
}

std::vector<Figure> chosen(const RunOptions& options) {
  std::vector<Figure> all = all_figures();
  if (options.figures.empty()) {
    if (options.paper_data)
      std::erase_if(all, [&](const Figure& figure) {
        return !read_prose(input_of(options, figure), figure).authors_difference;
      });
    return all;
  }
  std::vector<Figure> result;
  for (const int number : options.figures) {
    const auto found =
        std::find_if(all.begin(), all.end(), [number](const Figure& one) { return one.number == number; });
    if (found == all.end()) throw UsageError("there is no figure " + std::to_string(number));
    result.push_back(*found);
  }
  return result;
}

}  // namespace

std::string stem_of(int figure) {
  return (figure < 10 ? "figure_0" : "figure_") + std::to_string(figure);
}

Prose read_prose(const std::filesystem::path& input, const Figure& figure) {
  const Fields fields = Fields::of_file(input);
  if (fields.whole("figure", 1, 99) != figure.number) fields.refuse("figure", std::to_string(figure.number));
  return prose_of(fields);
}

void check_outputs(const RunOptions& options, const std::filesystem::path& page) {
  FilePlan plan;
  std::set<std::string> outputs = {timings_name};
  for (const Figure& figure : all_figures()) {
    plan.reads("the input", input_of(options, figure));
    for (const char* const ending : {".png", ".svg", ".numbers.json"})
      outputs.insert(stem_of(figure.number) + ending);
  }
  plan.reads_all("the model", options.paper_data ? *options.paper_data : options.models);
  if (!page.empty()) plan.writes("--page", page);
  plan.fills("--output", options.output, [&](const std::string& name) { return outputs.contains(name); });
  plan.check();
}

RunReport make_figures(const RunOptions& options, std::ostream& log) {
  require_folder(options.inputs, "inputs");
  require_folder(options.paper_data ? *options.paper_data : options.models, "models");
  const std::vector<Figure> figures = chosen(options);
  std::vector<PreparedFigure> prepared;
  for (const Figure& figure : figures)
    prepared.push_back(prepare(input_of(options, figure), figure, options.paper_data.has_value()));
  prepare_output(options.output);
  RunReport report;
  for (std::size_t k = 0; k < figures.size(); ++k) try {
      const FigureResult result = make_one(figures[k], prepared[k], options);
      ++report.figures;
      log << stem_of(figures[k].number) << "  " << figures[k].title << '\n';
      for (const Claim& claim : result.claims) {
        log << (claim.holds ? "  holds:         " : "  does not hold: ") << claim.says << '\n';
        if (!claim.holds) ++report.broken_claims;
      }
    } catch (const OutputError&) {
      throw;
    } catch (const Error& error) {
      report.failures.push_back("figure " + std::to_string(figures[k].number) + ": " + error.what());
    }
  return report;
}

}  // namespace stackabilization::figures
