#include "apps/improve/improve_page.h"

#include <cmath>

#include "apps/common/explanation_report.h"
#include "apps/common/text.h"
#include "apps/report/page.h"
#include "apps/report/page_view.h"
#include "stackabilization/core/direction_text.h"

namespace stackabilization::apps {

namespace {

/// A row of the comparison: a label and a number per solution.
template <class Number>
std::string row(const std::string& label, const std::vector<const SolutionReport*>& solutions,
                const Number& number) {
  std::string text = "<tr>" + element("th scope=\"row\"", label);
  for (const SolutionReport* solution : solutions) text += element("td class=\"number\"", number(*solution));
  return text + "</tr>\n";
}

std::string comparison(const ImproveReport& report) {
  const std::vector<const SolutionReport*> solutions = report.shown();
  if (solutions.empty()) return "";
  const Unit unit = report.task.rest().shape.unit;
  const auto add = [&](const std::string& label, const auto& number) {
    return row(label, solutions, number);
  };
  using Solution = SolutionReport;
  std::string text = element("h3", "All numbers") + "\n<div class=\"scroll\"><table>\n<thead><tr><th></th>";
  for (const SolutionReport* solution : solutions) text += element("th scope=\"col\"", title_of(*solution));
  text += "</tr></thead>\n<tbody>\n";
  text += add("Direction", [](const Solution& s) { return direction_text(s.candidate.direction); });
  text += add("S before", [](const Solution& s) { return stackability_text(s.before.value); });
  text += add("S after", [](const Solution& s) { return stackability_text(s.assessment.measured.value); });
  text += add("Each further copy adds, before",
              [&](const Solution& s) { return quantity(s.before.f_max, unit); });
  text += add("Each further copy adds, after",
              [&](const Solution& s) { return quantity(s.assessment.measured.f_max, unit); });
  text += add("Height of one copy",
              [&](const Solution& s) { return quantity(s.assessment.measured.extent, unit); });
  text += add("Direction, as numbers", [](const Solution& s) { return vector_text(s.candidate.direction); });
  text += add("Distortion D",
              [](const Solution& s) { return stackability_text(s.candidate.energy.distortion.total()); });
  text += add("  of volumes",
              [](const Solution& s) { return stackability_text(s.candidate.energy.distortion.volume); });
  text += add("  of distances",
              [](const Solution& s) { return stackability_text(s.candidate.energy.distortion.proximity); });
  text += add("  of the box",
              [](const Solution& s) { return stackability_text(s.candidate.energy.distortion.box); });
  text += add("  of symmetries",
              [](const Solution& s) { return stackability_text(s.candidate.energy.distortion.symmetry); });
  text += add("Energy E", [](const Solution& s) { return stackability_text(s.candidate.energy.value); });
  text += add("Change of the shape", [](const Solution& s) { return percent(s.change.root_mean_square); });
  return text + "</tbody></table></div>\n";
}

/// What else was asked for, and what independent methods say of the mesh as written; folded while all is
/// well.
std::string checks(const ImproveReport& report, const SolutionReport& solution) {
  std::string text;
  for (const Check& check : solution.assessment.checks)
    if (check.kind != CheckKind::quality)
      text += check_entry(check.passed, check_text(check, report.task.rest().structure));
  for (const Confirmation& check : solution.written) {
    const bool agrees = check.verdict != Verdict::disagrees;
    text +=
        check_entry(agrees, "written mesh, " + check.name + (agrees ? ": " : " DISAGREES: ") + check.note);
  }
  return std::string("<details class=\"faint\"") + (solution.good() ? ">" : " open=\"open\">") +
         element("summary", "Checks") + "\n<ul>\n" + text + "</ul></details>\n";
}

std::string links(const SolutionReport& solution) {
  std::string text;
  for (const char* ending : {".obj", ".3mf", ".stackabilize.json", ".json"}) {
    const std::string file = escaped(solution.name + ending);
    text += (text.empty() ? "" : " &#183; ") + ("<a href=\"" + file + "\">" + file + "</a>");
  }
  return "<p class=\"faint\">" + text + "</p>\n";
}

std::string article(const ImproveReport& report, const SolutionReport& solution) {
  const Unit unit = report.task.rest().shape.unit;
  std::string text = "<article id=\"" + escaped(solution.name) + "\">\n<h2>" + escaped(title_of(solution)) +
                     " <span class=\"" + (solution.good() ? "good" : "bad") + "\">S " +
                     escaped(stackability_text(solution.assessment.measured.value) + " " +
                             direction_text(solution.candidate.direction)) +
                     "</span></h2>\n";
  text += element("p class=\"headline\"",
                  headline_text(solution.before, solution.assessment.measured, solution.stack, unit)) +
          "\n";
  if (solution.holding)
    text += element("p", holding_text(*solution.holding, report.task.rest().shape.part_names)) + "\n";
  if (report.pictures_missing.empty()) {
    text += picture(solution.name + "_before_after.png", "before and after");
    text += picture(solution.name + "_stack.png", "stacks before and after");
  }
  if (solution.twist)
    text +=
        element("p", "Turned by " + rounded(solution.twist->twist_degrees) + " degrees from copy to copy, " +
                         std::to_string(solution.stack.copies) + " copies have S " +
                         stackability_text(solution.twist->stack.stackability) + ", straight " +
                         stackability_text(solution.twist->untwisted_stackability) + ".") +
        "\n";
  text += element("h3", "What changes") + "\n" + list("ul", explanation_lines(solution.explanation));
  text += near_limits(solution.assessment.checks, report.task.rest().structure);
  text += "<details class=\"faint\">" + element("summary", "Exact edits") + "\n" +
          list("ol", edit_lines(solution.candidate.design.edits, report.task.rest().shape.part_names)) +
          "</details>\n";
  text += checks(report, solution) + links(solution);
  return text + "</article>\n";
}

/// The curve of a front, and the designs along it.
std::string front(const ImproveReport& report) {
  if (!report.run.front || !report.pictures_missing.empty()) return "";
  std::string text = element("h3", "S against change") + "\n" +
                     picture("front.png", "the change of every design over its S") +
                     "<div class=\"strip\">\n";
  for (const SolutionReport& solution : report.solutions)
    text +=
        "<a href=\"#" + escaped(solution.name) + "\">" +
        picture(solution.name + "_before_after.png", title_of(solution)) +
        element("span", title_of(solution) + ", S " + stackability_text(solution.assessment.measured.value)) +
        "</a>\n";
  return text + "</div>\n";
}

/// The pieces of the object, where it stacks better taken apart.
std::string pieces(const ImproveReport& report) {
  if (report.pieces.empty()) return "";
  std::string text =
      element("h3", "Taken apart") + "\n" +
      element("p", "As given, but in pieces that are each stacked with their own kind, it has S " +
                       stackability_text(report.pieces_stackability) + ".") +
      "\n<div class=\"strip wide\">\n";
  for (const PieceReport& piece : report.pieces) {
    text += "<a href=\"" + escaped(piece.name) + ".obj\">";
    if (report.pictures_missing.empty()) text += picture(piece.name + "_stack.png", piece.name + ", stacked");
    text += element("span", piece_text(piece)) + "</a>\n";
  }
  return text + "</div>\n";
}

PageView view_of(const ImproveReport& report) {
  const std::vector<const SolutionReport*> shown = report.shown();
  if (shown.empty()) return {};
  const Shape& rest = report.task.rest().shape;
  std::vector<ViewedDesign> designs = {
      {"As given", rest.vertices, shown[0]->before, shown[0]->candidate.direction}};
  for (const SolutionReport* one : shown)
    designs.push_back({title_of(*one), one->candidate.design.shape.vertices, one->assessment.measured,
                       one->candidate.direction});
  return page_view(rest, designs);
}

std::string verdict(const ImproveReport& report) {
  const std::size_t count = report.solutions.size();
  if (report.reached())
    return element("p class=\"verdict good\"",
                   counted(static_cast<long long>(count), "solution") +
                       (report.run.front ? ", from least to most S; " : ", best first; ") +
                       end_text(report.run));
  return element("p class=\"verdict bad\"",
                 count == 0 ? "Not reached; " + end_text(report.run)
                            : "There are solutions, but a check contradicts them; " + end_text(report.run));
}

}  // namespace

std::string improvement_page(const ImproveReport& report) {
  const PageView view = view_of(report);
  const std::string title = title_of(report.task.model) + ", made to stack";
  std::string body = element("h1", title) + "\n" + verdict(report) + "\n";
  if (report.run.running) body += element("p", "Reload this page to see what has been found since.") + "\n";
  body += element("h3", "Asked for") + "\n" + list("ul", wish_lines(report));
  if (const Diagnosis* const diagnosis = report.diagnosis())
    body += element("h3", "Why it was not reached, and what would help") + "\n" +
            element("pre", text(*diagnosis, report.task.rest().structure)) + "\n";
  body += view.element + front(report);
  if (!report.pictures_missing.empty())
    body += element("p class=\"faint\"", "No pictures: " + report.pictures_missing + ".") + "\n";
  body += "<div class=\"solutions\">\n";
  for (const SolutionReport* solution : report.shown()) body += article(report, *solution);
  return html_page(title, view.head, body + "</div>\n" + pieces(report) + comparison(report));
}

}  // namespace stackabilization::apps
