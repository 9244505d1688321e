#include "apps/improve/improve_page.h"

#include <cmath>

#include "apps/common/explanation_report.h"
#include "apps/common/text.h"
#include "apps/improve/improve_view.h"
#include "stackabilization/core/direction_text.h"

namespace stackabilization::apps {

namespace {

constexpr const char* page_style = R"(
:root { color-scheme: light; --ink: #212429; --faint: #61666e; --line: #d9dce1; --good: #47803a; --bad: #c0262b; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem; max-width: 110rem; color: var(--ink); background: #fff;
  font: 16px/1.45 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 .3rem; overflow-wrap: anywhere; }
h2 { font-size: 1.25rem; margin: 0 0 .6rem; }
h3 { font-size: 1rem; margin: 1rem 0 .3rem; }
.verdict { font-size: 1.15rem; margin: 0 0 1rem; }
.headline { margin: 0 0 .6rem; }
.good { color: var(--good); }
.bad { color: var(--bad); }
.faint, .faint a { color: var(--faint); }
.scroll { overflow-x: auto; }
.solutions { display: grid; gap: 1.5rem; grid-template-columns: repeat(auto-fit, minmax(min(30rem, 100%), 1fr)); }
article { border: 1px solid var(--line); border-radius: 8px; padding: 1rem 1.2rem; min-width: 0; }
img { display: block; width: 100%; height: auto; margin: .6rem 0; }
table { border-collapse: collapse; margin: 1rem 0; }
th, td { text-align: left; padding: .25rem .9rem .25rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
ul, ol { margin: .2rem 0; padding-left: 1.4rem; overflow-wrap: anywhere; }
.strip { display: grid; gap: .8rem; grid-template-columns: repeat(auto-fill, minmax(12rem, 1fr)); }
.strip a { color: var(--faint); font-size: .85rem; text-decoration: none; }
details { font-size: .85rem; margin: .4rem 0; }
summary { cursor: pointer; }
.view { margin: 1.2rem 0 1.6rem; border: 1px solid var(--line); border-radius: 8px; overflow: hidden; }
.view:empty { display: none; }
.view .panes { position: relative; height: min(34rem, 70vh); }
.view canvas { display: block; width: 100%; height: 100%; touch-action: pan-y; }
.view .labels { position: absolute; inset: 0; display: flex; pointer-events: none; }
.view .labels span { flex: 1; padding: .5rem .9rem; border-left: 1px solid var(--line); font-size: .95rem; }
.view .labels span:first-child { border-left: 0; }
.view .tools { display: flex; flex-wrap: wrap; gap: .5rem 1.2rem; align-items: center; padding: .5rem .9rem;
  border-top: 1px solid var(--line); font-size: .9rem; color: var(--faint); }
.view .tools label { display: inline-flex; gap: .5rem; align-items: center; }
.view .tools button, .view .tools select { font: inherit; color: var(--ink); background: #fff; border: 1px solid var(--line);
  border-radius: 7px; padding: .15rem .7rem; cursor: pointer; }
pre { white-space: pre-wrap; font: inherit; margin: 0; }
)";

/// Measures of quality that use less than half of their limit are in the JSON only; see `violation`.
constexpr double near_limit = -0.05;

/// `text` as the content of an element.
std::string element(const std::string& name, const std::string& text) {
  return "<" + name + ">" + escaped(text) + "</" + name.substr(0, name.find(' ')) + ">";
}

std::string list(const std::string& name, const std::vector<std::string>& items) {
  std::string text = "<" + name + ">\n";
  for (const std::string& item : items) text += element("li", item) + "\n";
  return text + "</" + name + ">\n";
}

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

std::string picture(const std::string& file, const std::string& words) {
  return "<img src=\"" + escaped(file) + "\" alt=\"" + escaped(words) + "\"/>\n";
}

std::string check_line(bool good, const std::string& words) {
  return element(good ? "li" : "li class=\"bad\"", words) + "\n";
}

/// The measures of quality that come near their limits, or break them.
std::string quality(const ImproveReport& report, const SolutionReport& solution) {
  std::string text;
  for (const Check& check : solution.assessment.checks)
    if (check.kind == CheckKind::quality && violation(check) > near_limit)
      text += check_line(check.passed, check_text(check, report.task.rest().structure));
  return text.empty() ? "" : element("h3", "Near a limit of quality") + "\n<ul>\n" + text + "</ul>\n";
}

/// What else was asked for, and what independent methods say of the mesh as written; folded while all is
/// well.
std::string checks(const ImproveReport& report, const SolutionReport& solution) {
  std::string text;
  for (const Check& check : solution.assessment.checks)
    if (check.kind != CheckKind::quality)
      text += check_line(check.passed, check_text(check, report.task.rest().structure));
  for (const WrittenCheck& check : solution.written) {
    const bool agrees = check.verdict != WrittenCheck::Verdict::disagrees;
    text += check_line(agrees, "written mesh, " + check.name + (agrees ? ": " : " DISAGREES: ") + check.note);
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
  text += element("p class=\"headline\"", "Each further copy adds " +
                                              quantity(solution.assessment.measured.f_max, unit) +
                                              " instead of " + quantity(solution.before.f_max, unit) + ". " +
                                              saving_text(solution.stack, unit) + ".") +
          "\n";
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
  text += quality(report, solution);
  text += "<details class=\"faint\">" + element("summary", "Exact edits") + "\n" +
          list("ol", edit_lines(report.task, solution)) + "</details>\n";
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

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool is_control = static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t';
    if (is_control || c == '\x7f')
      result += "&#xFFFD;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&#39;";
    else
      result += c;
  }
  return result;
}

std::string improvement_page(const ImproveReport& report) {
  const std::string model = title_of(report.task.model);
  std::string page =
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"/>\n";
  const PageView view = page_view(report);
  page += element("title", model + ", made to stack") + "\n<style>" + page_style + "</style>\n" + view.head +
          "</head>\n<body>\n";
  page += element("h1", model + ", made to stack") + "\n" + verdict(report) + "\n";
  page += element("h3", "Asked for") + "\n" + list("ul", wish_lines(report));
  if (report.run.result.diagnosis && !(report.run.front && report.reached()))
    page += element("h3", "Why it was not reached, and what would help") + "\n" +
            element("pre", text(*report.run.result.diagnosis, report.task.rest().structure)) + "\n";
  page += view.element + front(report);
  if (!report.pictures_missing.empty())
    page += element("p class=\"faint\"", "No pictures: " + report.pictures_missing + ".") + "\n";
  page += "<div class=\"solutions\">\n";
  for (const SolutionReport* solution : report.shown()) page += article(report, *solution);
  return page + "</div>\n" + comparison(report) + "</body>\n</html>\n";
}

}  // namespace stackabilization::apps
