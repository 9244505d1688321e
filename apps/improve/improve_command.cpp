#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "apps/common/command.h"
#include "apps/common/explanation_report.h"
#include "apps/common/interrupt.h"
#include "apps/common/rendering.h"
#include "apps/improve/improve_files.h"
#include "apps/improve/improve_page.h"
#include "apps/improve/improve_project.h"
#include "apps/improve/improve_report.h"
#include "stackabilization/deformation/rebase.h"
#include "stackabilization/improvement/change_measure.h"
#include "stackabilization/structure/project_file.h"

namespace stackabilization::apps {

namespace {

namespace fs = std::filesystem;

/// More copies than that are a comb.
constexpr int max_compared_copies = 20;

/// Lines of an explanation in a picture.
constexpr std::size_t max_notes = 4;

/// Fills the folder, and knows what is in it. Killed at any moment, it leaves whole files of which the
/// summaries say nothing wrong, and until the last one is there the state to go on from.
class Writer {
 public:
  explicit Writer(ImproveReport& report) : report_(report), owned_(improve_folder(report.options)) {}

  /// Before anything is written. What was there before the search may be something else by now.
  void begin() {
    std::vector<std::string> names = summary_names();
    for (const SolutionReport* solution : report_.shown()) {
      const std::vector<std::string> files = solution_files(solution->name);
      names.insert(names.end(), files.begin(), files.end());
    }
    for (const PieceReport& piece : report_.pieces) {
      const std::vector<std::string> files = piece_files(piece.name);
      names.insert(names.end(), files.begin(), files.end());
    }
    owned_.begin(names);
    for (const std::string& name : summary_names()) owned_.remove(name);
  }

  void write_summaries(Json document) {
    document.erase("seconds");  // every run fills the folder with the same bytes
    owned_.remove_others(written_);
    write(project_name, project_text(improvement_project(report_)));
    if (report_.run.front) write("front.csv", front_table(report_));
    write("result.json", json_text(document));
    write("index.html", improvement_page(report_));
    if (ended_by_itself(report_.run)) owned_.remove(state_file(folder_).filename().string());
    owned_.finish(written_);
  }

  /// Everything that is drawn or asked of the mesh of a solution belongs to its report.
  void write_meshes(SolutionReport& solution) {
    const Design& design = solution.candidate.design;
    const std::string mesh = solution.name + ".obj";
    write_mesh(mesh, design.shape);
    write_mesh(solution.name + ".3mf", design.shape);
    write(solution.name + std::string(project_suffix), project_text(rebase(report_.task.rest(), design)));
    solution.written = confirm(report_.task.checker(), read_shape(folder_ / mesh), solution.direction(),
                               solution.assessment);
  }

  void write_pictures(const SolutionReport& solution) {
    draw_if_possible([&] { draw(solution); });
  }

  void write_piece(const PieceReport& piece) {
    write_mesh(piece.name + ".obj", piece.shape);
    draw_if_possible([&] { draw(piece); });
  }

  void write_front_picture() {
    if (!report_.run.front) return;
    std::vector<Eigen::Vector2d> points;
    for (const FrontPoint& point : report_.run.front->points)
      points.emplace_back(point.assessment.measured.value, 100 * point.change);
    draw_if_possible([&] {
      apps::write_front_picture(
          {(folder_ / "front.png").string(), title_of(report_.task.model) + ", S against change"}, points);
      written_.emplace_back("front.png");
    });
  }

  void write_report(const SolutionReport& solution) {
    write(solution.name + ".json", json_text(solution_json(report_, solution)));
  }

 private:
  /// Draws, unless pictures are missing; a picture that cannot be drawn is the last one that is tried.
  template <class Draw>
  void draw_if_possible(const Draw& draw) {
    if (!report_.pictures_missing.empty()) return;
    try {
      draw();
    } catch (const RenderError& error) {
      report_.pictures_missing = error.what();
    }
  }

  void write(const std::string& name, const std::string& text) {
    write_output((folder_ / name).string(), text);
    written_.push_back(name);
  }

  void write_mesh(const std::string& name, const Shape& shape) {
    CommonOptions silent = report_.options.common;
    silent.quiet = true;  // solutions are in whatever unit the model is in
    write_mesh_output(silent, (folder_ / name).string(), shape);
    written_.push_back(name);
  }

  void draw(const SolutionReport& solution) {
    const StructuredShape& rest = report_.task.rest();
    const Shape& after = solution.candidate.design.shape;
    ContactOptions options;
    options.semantics = report_.options.measure.semantics;
    const std::vector<ContactRegion> contacts_before =
        contact_regions(rest.shape, solution.direction(), options).regions;
    const std::vector<ContactRegion> contacts = contact_regions(after, solution.direction(), options).regions;
    ComparedDesigns designs{{rest.shape, solution.before, contacts_before},
                            {after, solution.assessment.measured, contacts},
                            explanation_lines(solution.explanation, max_notes)};
    const std::string title = title_of(report_.task.model) + ", " + title_of(solution);
    const std::string pair = solution.name + "_before_after.png", stack = solution.name + "_stack.png";
    write_improvement_picture({(folder_ / pair).string(), title}, designs);
    designs.notes = {saving_text(solution.stack, rest.shape.unit)};
    write_stacks_picture({(folder_ / stack).string(), title}, designs,
                         std::min(solution.stack.copies, max_compared_copies));
    written_.insert(written_.end(), {pair, stack});
  }

  /// The copies of a piece, one on top of the other.
  void draw(const PieceReport& piece) {
    const Direction direction(piece.piece.direction);
    const int copies = std::min(report_.options.shown_copies(), max_compared_copies);
    PlacedCopies stack{{}, direction, {piece_text(piece)}};
    for (int k = 0; k < copies; ++k)
      stack.copies.push_back(
          transformed(piece.shape, Eigen::Matrix3d::Identity(), k * piece.measured.f_max * direction.unit()));
    const std::string picture = piece.name + "_stack.png";
    write_stack_picture({(folder_ / picture).string(), title_of(report_.task.model) + ", " + piece.name},
                        stack);
    written_.push_back(picture);
  }

  ImproveReport& report_;
  OwnedFolder owned_;
  fs::path folder_ = owned_.path();
  std::vector<std::string> written_;
};

/// Fills the report with the solutions and what is known about them, or with what came nearest.
void report_solutions(ImproveReport& report) {
  const Improvement& result = report.run.result;
  const auto reported = [&report](const Candidate& candidate, const Assessment& assessment,
                                  std::string name) {
    SolutionReport solution = solution_report(report.options, report.task, candidate, assessment);
    solution.name = std::move(name);
    return solution;
  };
  for (std::size_t i = 0; i < result.solutions.size(); ++i)
    report.solutions.push_back(
        reported(result.solutions[i], result.assessments.at(i), "solution_" + std::to_string(i + 1)));
  if (report.run.front)
    for (std::size_t i = 0; i < report.solutions.size(); ++i)
      report.solutions[i].target = report.run.front->points[i + 1].target;
  if (report.solutions.empty() && result.nearest)
    report.nearest = reported(
        *result.nearest,
        report.task.checker().check(result.nearest->design, Direction(result.nearest->direction)), "nearest");
}

/// Their files.
void write_solutions(ImproveReport& report, Writer& writer) {
  const auto write = [&](SolutionReport& solution) {
    writer.write_meshes(solution);
    writer.write_pictures(solution);
    writer.write_report(solution);
  };
  writer.begin();
  for (SolutionReport& solution : report.solutions) write(solution);
  if (report.nearest) write(*report.nearest);
  for (const PieceReport& piece : report.pieces) writer.write_piece(piece);
  writer.write_front_picture();
}

/// What a caller gets in the place of files.
void hand_over_solutions(ImproveReport& report, Caller& caller) {
  const auto hand_over = [&](SolutionReport& solution) {
    const Design& design = solution.candidate.design;
    solution.written =
        confirm(report.task.checker(), design.shape, solution.direction(), solution.assessment);
    caller.written_meshes[solution.name] = design.shape;
    caller.written_texts[solution.name] = project_text(rebase(report.task.rest(), design));
  };
  for (SolutionReport& solution : report.solutions) hand_over(solution);
  if (report.nearest) hand_over(*report.nearest);
  caller.written_texts["project"] = project_text(improvement_project(report));
}

Json document_of(const CLI::App& command, const ImproveReport& report, const Stopwatch& watch) {
  Json document = document_head(command, report.task.model);
  add_improvement(document, report);
  add_document_tail(document, report.options.common, report.task.model, watch);
  return document;
}

/// A function that is told of every design on the way to the solutions.
using Teller = std::function<void(const ImproveRun&, const Candidate&)>;

/// A design that was found while the search goes on.
SolutionReport found_report(const ImproveCommandOptions& options, const ImproveTask& task,
                            const Candidate& candidate, std::string name) {
  SolutionReport solution = solution_report(
      options, task, candidate, task.checker().check(candidate.design, Direction(candidate.direction)));
  solution.name = std::move(name);
  return solution;
}

/// Tells a caller of every design.
Teller telling_caller(const ImproveCommandOptions& options, const ImproveTask& task) {
  const Caller* const caller = options.common.caller;
  if (!caller->found) return {};
  return [&options, &task, caller](const ImproveRun& run, const Candidate& candidate) {
    const ImproveReport report{options, task, run, {}, {}, {}};
    caller->found(solution_json(report, found_report(options, task, candidate, "design")),
                  candidate.design.shape);
  };
}

/// Keeps the best design so far in the folder, without pictures, so that there is something to look at
/// before the search ends. A front is told of as a whole.
Teller filling_folder(const CLI::App& command, const ImproveCommandOptions& options, const ImproveTask& task,
                      const Stopwatch& watch) {
  if (options.front) return {};
  return [&, least = std::optional<double>()](const ImproveRun& run, const Candidate& candidate) mutable {
    const double change = options.preset == ImprovementPreset::paper
                              ? candidate.energy.value
                              : size_of(options.objective, candidate, task.rest().shape);
    if (least && change >= *least) return;
    least = change;
    ImproveReport report{options, task, run, {}, {}, "they are drawn when the search has ended"};
    report.solutions.push_back(found_report(options, task, candidate, "solution_1"));
    try {
      Writer writer(report);
      writer.begin();
      writer.write_meshes(report.solutions.front());
      writer.write_report(report.solutions.front());
      writer.write_summaries(document_of(command, report, watch));
    } catch (const OutputError&) {
      // What is in the way now is told of at the end, when the search is not lost by it.
    }
  };
}

/// "0.8 3": S of the best solution, or of what came nearest, and the number of solutions.
std::string essential_improvement(const ImproveReport& report) {
  const std::vector<const SolutionReport*> shown = report.shown();
  return (shown.empty() ? "undefined" : exact_digits(shown.front()->assessment.measured.value)) + " " +
         std::to_string(report.solutions.size()) + "\n";
}

int run_improve_command(const CLI::App& command, const ImproveCommandOptions& options) {
  const Stopwatch watch;
  check(options);
  const ThreadLimit limit(options.common);
  const ImproveTask task = improve_task(command, options, watch);
  Caller* const caller = options.common.caller;
  if (!caller) improve_folder(options).make();
  const ImproveRun found =
      run_improve(options, task, watch,
                  caller ? telling_caller(options, task) : filling_folder(command, options, task, watch));

  ImproveReport report{options, task, found, {}, {}, {}};
  report.pictures_missing = options.no_pictures ? "left out by --no-pictures" : rendering_missing();
  report_solutions(report);
  if (const Remedy* const offer = offer_of_pieces(report.diagnosis())) {
    report.pieces = pieces_of(*offer, task);
    report.pieces_stackability = offer->stackability;
  }
  std::optional<Writer> writer;
  if (caller)
    hand_over_solutions(report, *caller);
  else
    write_solutions(report, writer.emplace(report));
  const Json document = document_of(command, report, watch);
  if (writer) writer->write_summaries(document);
  deliver(options.common, document,
          options.common.quiet ? essential_improvement(report) : improvement_text(report));
  if (found.interrupted) throw Interrupted();
  return report.reached() ? status_done : status_no;
}

}  // namespace

Command make_improve_command(CLI::App& program) {
  const auto options = std::make_shared<ImproveCommandOptions>();
  CLI::App* const command =
      add_command(program, "improve", "Change a design as little as possible so that it stacks as asked for",
                  "stackabilize improve table.obj --target 0.8 --keep top -o table_stackable");
  add_improve_options(*command, *options);
  return {command, [command, options] { return run_improve_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
