#include <algorithm>
#include <memory>
#include <vector>

#include "apps/common/command.h"
#include "apps/common/measurement.h"
#include "apps/common/output.h"
#include "apps/common/rendering.h"
#include "apps/common/values.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/draft.h"

namespace stackabilization::apps {

namespace {

constexpr double default_draft = 1;
constexpr double right_angle = 90;
constexpr std::size_t listed_parts = 20;

struct DraftCommandOptions {
  CommonOptions common;
  std::optional<Eigen::Vector3d> direction;
  std::optional<double> draft_degrees;
  std::optional<std::string> table, picture;
};

/// Draft of a part, or of all of them. Areas in model units squared.
struct DraftSummary {
  double area = 0;                  ///< of the surface, without what lies inside the solid
  double undercut = 0;              ///< of the portion of it that is undercut
  double little = 0;                ///< of the portion that is not, with less draft than asked for
  double inner = 0;                 ///< inside the solid
  std::optional<double> min_draft;  ///< draft of what is not undercut, degrees; nothing where all is

  void add(const TriangleDraft& triangle, double enough) {
    area += triangle.area - triangle.inner_area;
    undercut += triangle.undercut_area;
    inner += triangle.inner_area;
    if (!(triangle.free_area() > tolerance::relative * triangle.area)) return;
    if (triangle.angle < enough) little += triangle.free_area();
    min_draft = std::min(min_draft.value_or(right_angle), triangle.angle);
  }
};

/// Summaries per part, and one of the whole at the end.
std::vector<DraftSummary> summaries_of(const Shape& shape, const DraftAnalysis& draft, double enough) {
  std::vector<DraftSummary> summaries(shape.part_names.size() + 1);
  for (std::size_t t = 0; t < draft.triangles.size(); ++t) {
    summaries[static_cast<std::size_t>(shape.triangle_part[t])].add(draft.triangles[t], enough);
    summaries.back().add(draft.triangles[t], enough);
  }
  return summaries;
}

Json summary_json(const DraftSummary& summary) {
  return {{"area", summary.area},
          {"undercut_area", summary.undercut},
          {"little_draft_area", summary.little},
          {"inner_area", summary.inner},
          {"min_draft_degrees", to_json(summary.min_draft)}};
}

Json parts_json(const Shape& shape, const std::vector<DraftSummary>& summaries) {
  Json parts = Json::array();
  for (std::size_t part = 0; part < shape.part_names.size(); ++part) {
    Json one = {{"name", shape.part_names[part]}};
    one.update(summary_json(summaries[part]));
    parts.push_back(std::move(one));
  }
  return parts;
}

std::string csv_text(const DraftAnalysis& draft) {
  std::string text = "triangle,draft_degrees,area,undercut_area,inner_area\n";
  for (std::size_t t = 0; t < draft.triangles.size(); ++t) {
    const TriangleDraft& triangle = draft.triangles[t];
    text += std::to_string(t);
    for (const double value : {triangle.angle, triangle.area, triangle.undercut_area, triangle.inner_area})
      text += "," + exact_digits(value);
    text += "\n";
  }
  return text;
}

std::string share_text(double area, const DraftSummary& of, Unit unit) {
  return quantity(area, unit, 2) + (of.area > 0 ? ", " + percent(area / of.area) : "");
}

std::string min_draft_text(const DraftSummary& summary) {
  return summary.min_draft ? degrees_text(*summary.min_draft) : "none";
}

/// The parts with an undercut, the largest one first.
std::string undercut_parts_text(const Shape& shape, const std::vector<DraftSummary>& summaries) {
  std::vector<std::size_t> parts;
  for (std::size_t part = 0; part + 1 < summaries.size(); ++part)
    if (summaries[part].undercut > 0) parts.push_back(part);
  if (parts.empty() || shape.part_count() == 1) return "";
  std::stable_sort(parts.begin(), parts.end(), [&](std::size_t a, std::size_t b) {
    return summaries[a].undercut > summaries[b].undercut;
  });
  ColumnTable table({"Part", "Undercut", "Least draft"});
  for (std::size_t k = 0; k < std::min(parts.size(), listed_parts); ++k)
    table.add({shape.part_names[parts[k]],
               share_text(summaries[parts[k]].undercut, summaries[parts[k]], shape.unit),
               min_draft_text(summaries[parts[k]])});
  if (parts.size() > listed_parts) table.add({"...", "all of them with --json", ""});
  return "\n" + table.text();
}

std::vector<std::string> picture_notes(const DraftSummary& whole, double enough, Unit unit) {
  return {"undercut: " + share_text(whole.undercut, whole, unit),
          "less than " + degrees_text(enough) + " of draft: " + share_text(whole.little, whole, unit)};
}

std::string draft_text(const Model& model, const Direction& direction, const DraftAnalysis& draft,
                       const std::vector<DraftSummary>& summaries, double enough) {
  const Unit unit = model.shape.unit;
  const DraftSummary& whole = summaries.back();
  TextTable table;
  add_model_line(table, model);
  table.add("Direction", vector_text(direction.vector()), "the halves of the mould part along it");
  table.add(
      "Surface", quantity(whole.area, unit, 2),
      whole.inner > 0 ? "without " + quantity(whole.inner, unit, 2) + " where parts touch or overlap" : "");
  table.add("Undercut", share_text(whole.undercut, whole, unit),
            whole.undercut > 0 ? "of the surface: neither half can leave it"
                               : "of the surface: nothing holds the object in the mould");
  if (!draft.complete)
    table.add("", "at least", "there are too many triangles above each other to look at all");
  table.add("Least draft", min_draft_text(whole),
            "of what is not undercut; a wall along the direction has 0");
  table.add("", share_text(whole.little, whole, unit),
            "of the surface has less than " + degrees_text(enough));
  return table.text() + undercut_parts_text(model.shape, summaries);
}

int run_draft_command(const CLI::App& command, const DraftCommandOptions& options) {
  const Stopwatch watch;
  check_outputs(options.common,
                {{{"--output", options.table}, {"--picture", options.picture, OutputKind::picture}}});
  if (options.picture) require_rendering();
  const Direction direction(options.direction.value_or(Eigen::Vector3d::UnitZ()));
  const double enough = options.draft_degrees.value_or(default_draft);
  const ThreadLimit limit(options.common);
  const Model model = load_model(options.common);
  const DraftAnalysis draft = analyse_draft(model.shape, SeparationTree(model.shape), direction);
  const std::vector<DraftSummary> summaries = summaries_of(model.shape, draft, enough);

  Json document = document_head(command, model);
  document["direction"] = to_json(direction.vector());
  document["draft_degrees"] = enough;
  document["complete"] = draft.complete;
  document.update(summary_json(summaries.back()));
  document["parts"] = parts_json(model.shape, summaries);
  add_document_tail(document, options.common, model, watch);
  if (options.table) write_text_output(options.common, *options.table, csv_text(draft));
  if (options.picture)
    write_draft_picture(
        {*options.picture, title_of(model)},
        {model.shape, draft, direction, enough, picture_notes(summaries.back(), enough, model.shape.unit)});
  const std::string text = options.common.quiet ? exact_digits(summaries.back().undercut) + "\n"
                                                : draft_text(model, direction, draft, summaries, enough);
  deliver(options.common, document, options.table == "-" ? "" : text);
  return status_done;
}

}  // namespace

Command make_draft_command(CLI::App& program) {
  const auto options = std::make_shared<DraftCommandOptions>();
  CLI::App* const command =
      add_command(program, "draft", "Say what is undercut, and how much draft the rest has",
                  "stackabilize draft crate.obj --draft-degrees 2 --picture crate.png");
  add_common_options(*command, options->common);
  add_direction(*command, "--direction", options->direction,
                "The halves of the mould part along it (default: 0 0 1)");
  add_number(*command,
             {"--draft-degrees", "Draft that is enough, degrees, up to 90 (default: 1)", 0, right_angle},
             options->draft_degrees);
  command
      ->add_option("-o,--output", options->table, "Write a table, one line per triangle (CSV; - is stdout)")
      ->type_name("FILE");
  command->add_option("--picture", options->picture, "Draw the shape from above and below (.png or .svg)")
      ->type_name("FILE");
  return {command, [command, options] { return run_draft_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
