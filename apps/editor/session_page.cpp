#include "apps/editor/session_page.h"

#include <vector>

#include "apps/common/explanation_report.h"
#include "apps/common/text.h"
#include "apps/report/design_words.h"
#include "apps/report/page.h"
#include "apps/report/page_view.h"
#include "stackabilization/core/direction_text.h"

namespace stackabilization::apps {

namespace {

using editing::EditingSession, editing::MeasuredDesign;

/// A row of the table of numbers.
std::string row(const std::string& label, const std::string& before, const std::string& after) {
  return "<tr>" + element("th scope=\"row\"", label) + element("td class=\"number\"", before) +
         element("td class=\"number\"", after) + "</tr>\n";
}

std::string numbers(const EditingSession& session, const StackHeights& stack) {
  const Stackability& before = session.at_rest();
  const MeasuredDesign& shown = session.shown();
  const Stackability& after = shown.assessment.measured;
  const Unit unit = session.space().rest().shape.unit;
  std::string text = element("h3", "All numbers") + "\n<div class=\"scroll\"><table>\n<thead><tr><th></th>" +
                     element("th scope=\"col\"", "As given") + element("th scope=\"col\"", "Edited") +
                     "</tr></thead>\n<tbody>\n";
  text += row("S", stackability_text(before.value), stackability_text(after.value));
  text += row("Each further copy adds", quantity(before.f_max, unit), quantity(after.f_max, unit));
  text += row("Height of one copy", quantity(before.extent, unit), quantity(after.extent, unit));
  text += row(std::to_string(stack.copies) + " copies", quantity(stack.before, unit),
              quantity(stack.after, unit));
  text += row("Distortion D", "0", stackability_text(shown.energy.distortion.total()));
  text += row("Energy E", "0", stackability_text(shown.energy.value));
  text += row("Change of the shape", percent(0), percent(shown.change.root_mean_square));
  return text + "</tbody></table></div>\n";
}

Explanation explanation_of(const EditingSession& session) {
  if (session.review() && !session.dragging()) return session.review()->explanation;
  const Design& design = *session.shown().design;
  return explain(session.space().rest(), design.shape, {.edits = design.edits, .reasons = {}});
}

std::string wish_text(const EditingSession& session) {
  const Requirements& wishes = session.checker().requirements();
  if (!wishes.length_limit) return stackability_text(wishes.target);
  return std::to_string(wishes.length_limit->copies) + " copies within " +
         quantity(wishes.length_limit->length, session.space().rest().shape.unit);
}

const std::vector<Check>& checks_of(const EditingSession& session) {
  return session.review() && !session.dragging() ? session.review()->assessment.checks
                                                 : session.shown().assessment.checks;
}

}  // namespace

std::string session_page(const EditingSession& session, const std::string& name, int copies) {
  const StructuredShape& rest = session.space().rest();
  const MeasuredDesign& shown = session.shown();
  const Stackability &before = session.at_rest(), &after = shown.assessment.measured;
  const Eigen::Vector3d direction = session.direction().vector();
  const StackHeights stack{copies, before.stack_height(copies), after.stack_height(copies), {}};
  const bool reached = session.checker().meets_target(after);
  const std::string title = name + ", edited to stack";
  const PageView view = page_view(rest.shape, {{"As given", rest.shape.vertices, before, direction},
                                               {"Edited", shown.design->shape.vertices, after, direction}});
  std::string body = element("h1", title) + "\n";
  body += element(std::string("p class=\"verdict ") + (reached ? "good\"" : "bad\""),
                  "S " + stackability_text(after.value) + " " + direction_text(direction) + ", " +
                      stackability_text(before.value) + " as given; asked for " + wish_text(session) +
                      (reached ? "" : ", not reached")) +
          "\n";
  body += element("p class=\"headline\"", shown.design->edits.empty()
                                              ? "Nothing is changed yet."
                                              : headline_text(before, after, stack, rest.shape.unit)) +
          "\n";
  body += view.element;
  body += element("h3", "What changes") + "\n" + list("ul", explanation_lines(explanation_of(session)));
  body += near_limits(checks_of(session), rest.structure);
  body += element("h3", "Edits") + "\n" + list("ol", edit_lines(shown.design->edits, rest.shape.part_names));
  return html_page(title, view.head, body + numbers(session, stack));
}

}  // namespace stackabilization::apps
