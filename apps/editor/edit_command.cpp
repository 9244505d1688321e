#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>

#include "apps/common/command.h"
#include "apps/common/output.h"
#include "apps/common/requirement_options.h"
#include "apps/common/structured_model.h"
#include "apps/common/values.h"
#include "apps/editor/room.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/fingerprint.h"
#include "stackabilization/core/part_names.h"
#include "stackabilization/core/text.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/improvement/rest_shape.h"
#include "stackabilization/io/format.h"
#include "stackabilization/io/read.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/io/write_file.h"
#include "stackabilization/structure/analysis.h"

namespace stackabilization::apps {

namespace {

struct EditCommandOptions {
  CommonOptions common;
  AnalysisArguments analysis;
  StackabilityOptions measure;
  std::optional<Eigen::Vector3d> direction;
  std::optional<double> target;
  StackRoom room;
  std::optional<std::string> session, study;
  int port = 0;
  bool fresh = false, keep_open = false, no_browser = false;
};

std::string session_file_of(const std::string& model) {
  return model + ".session.json";
}

std::filesystem::path session_file(const EditCommandOptions& options) {
  if (options.study) return {};
  if (options.session) return *options.session;
  if (options.common.model == "-") return {};
  return session_file_of(options.common.model);
}

/// A hash of a file, so that a session is not gone on with for another shape.
std::string source_of_bytes(std::string_view bytes) {
  Fingerprint fingerprint;
  fingerprint.add(bytes);
  return std::to_string(fingerprint.value());
}

std::string source_of(const EditCommandOptions& options) {
  return options.common.model == "-" ? "" : source_of_bytes(read_file(options.common.model));
}

std::string stem_of(const std::string& name) {
  return name.substr(0, name.find('.'));
}

/// Where the session of a mesh file is saved.
struct SessionPlace {
  std::filesystem::path file;  ///< of the session
  std::string model, source;   ///< name of the mesh file, and the hash of what it holds now
  std::string remedy;          ///< for a person whose session was made of another file
};

/// Returns the session that was saved; nothing if there is no such file. Throws UsageError with the remedy if
/// it was made of another file.
std::optional<editing::Document> saved_document(const SessionPlace& place,
                                                const StackabilityOptions& measure) {
  std::error_code error;
  if (place.file.empty() || !std::filesystem::exists(place.file, error)) return std::nullopt;
  const std::string name = place.file.string();
  editing::Document document = editing::document_of_text(read_file(place.file), name, measure);
  if (document.source != place.source)
    throw UsageError(place.model + " is not the file that " + name + " was made of: " + place.remedy);
  return document;
}

/// Says what a session that goes on makes of options that only a new one can obey. Throws UsageError for
/// another direction.
void check_options_of_saved(const CLI::App& command, const EditCommandOptions& options,
                            const editing::Document& saved) {
  const std::string goes_on = "the session of " + session_file(options).string() + " goes on";
  const History& history = saved.project.history;
  const Eigen::Vector3d& direction = history.nodes[static_cast<std::size_t>(history.current)].direction;
  if (options.direction && !options.direction->normalized().isApprox(direction.normalized()))
    throw UsageError(goes_on + " stacked " + direction_text(direction) +
                     ", not as --direction says: --fresh begins anew, --session names another file");
  if (const auto option = given_mesh_option(command); option && !options.common.quiet)
    std::cerr << "stackabilize: " << goes_on << " with the shape and the structure that it holds, without "
              << *option << "; --fresh begins anew\n";
}

editing::Document fresh_document(const CLI::App& command, const EditCommandOptions& options) {
  StructuredModel input = load_structured(command, options.common, options.analysis, bounds_of_designs);
  editing::Document document = named(input.model, [&] {
    if (!input.history.nodes.empty())
      return editing::document_of({std::move(input.structured), std::move(input.history), input.space},
                                  options.measure);
    return editing::new_document(std::move(input.structured), options.measure);
  });
  if (options.direction) {
    HistoryNode& root = document.project.history.nodes.front();
    root.direction = *options.direction;
    root.stackability =
        stackability(document.project.rest.shape, Direction(root.direction), options.measure).value;
  }
  document.source = source_of(options);
  return document;
}

AnalysisOptions options_of_designs() {
  AnalysisOptions options;
  options.max_parts = bounds_of_designs.max_parts;
  options.joints.max_pairs = bounds_of_designs.max_pairs;
  return options;
}

/// Replaces what is wanted by what the options say.
void set_wish(const EditCommandOptions& options, editing::Document& document) {
  Requirements& wishes = document.requirements;
  if (options.target) {
    wishes.target = *options.target;
    wishes.length_limit.reset();
  }
  const StructuredShape& rest = document.project.rest;
  if (const auto limit = options.room.limit(rest.shape.unit)) {
    const History& history = document.project.history;
    const Direction direction(history.nodes[static_cast<std::size_t>(history.current)].direction);
    wishes.target = target_within(*limit, RestShape(rest, options.measure), direction);
    wishes.length_limit = limit;
  }
}

/// Makes a document of a mesh file that was dropped onto the page, and writes the file beside MODEL, so that
/// `edit` opens it again. A session that was saved for it goes on.
DroppedModel dropped_model(const EditCommandOptions& options, SessionLocks& locks, const std::string& name,
                           const std::string& bytes) {
  if (name.empty() || name.size() > 200 || name.front() == '.' ||
      name.find_first_of(std::string("/\\\0", 3)) != std::string::npos)
    throw UsageError(in_quotes(name) + " is no name of a mesh file");
  const std::filesystem::path folder = options.common.model == "-"
                                           ? std::filesystem::path(".")
                                           : std::filesystem::path(options.common.model).parent_path();
  const std::filesystem::path file = folder / name;
  std::error_code error;
  const bool exists = std::filesystem::exists(file, error);
  if (exists && read_file(file) != bytes) throw UsageError(file.string() + " exists and is another file");
  DroppedModel dropped{{}, name, stem_of(name), session_file_of(file.string()), nullptr};
  dropped.lock = locks.take(dropped.autosave);
  const std::string source = source_of_bytes(bytes);
  if (auto saved =
          saved_document({dropped.autosave, name, source, "move one of them away"}, options.measure)) {
    dropped.document = std::move(*saved);
  } else {
    const Shape shape = read_shape(bytes, format_of_extension(name), name);
    dropped.document = editing::new_document(analyse_structure(shape, options_of_designs()), options.measure);
    dropped.document.source = source;
  }
  if (!exists) write_file_atomically(file, bytes);
  return dropped;
}

/// Makes the document of a task of a study. Throws InputError naming the task.
editing::Document task_document(const EditCommandOptions& options, const editing::StudyPlanTask& task) {
  const std::filesystem::path file = std::filesystem::path(options.common.model).parent_path() / task.model;
  StructuredShape structured = analyse_structure(read_shape(file), options_of_designs());
  if (!task.without.empty())
    structured = without_parts(structured, stackabilization::parts_named(structured.shape, task.without));
  editing::Document document = editing::new_document(std::move(structured), options.measure);
  HistoryNode& root = document.project.history.nodes.front();
  root.direction = task.direction;
  root.stackability =
      stackability(document.project.rest.shape, Direction(root.direction), options.measure).value;
  document.requirements.target = task.target;
  return document;
}

/// Reads the plan of a study, and gives its next participant a number.
StudyOptions study_options(const EditCommandOptions& options) {
  StudyOptions study;
  study.plan = editing::study_plan_of_text(read_file(options.common.model), options.common.model);
  study.results = *options.study;
  std::error_code error;
  if (std::filesystem::exists(study.results, error))
    study.participant = editing::last_participant(read_file(study.results), study.results.string()) + 1;
  study.open = [&options](const editing::StudyPlanTask& task) { return task_document(options, task); };
  return study;
}

/// Opens the address in the browser of the desktop, where there is one.
void open_browser(const std::string& address) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  std::string program = "xdg-open", argument = address;
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  pid_t process = 0;
  posix_spawnp(&process, program.c_str(), nullptr, nullptr, arguments, environ);
}

/// Where the session stands: {session, target, current, designs: [{name, parent, stackability, energy}]}
void add_session(Json& document, const EditCommandOptions& options, const editing::Document& session) {
  const History& history = session.project.history;
  Json designs = Json::array();
  for (const HistoryNode& node : history.nodes)
    designs.push_back({{"name", node.name},
                       {"parent", node.parent},
                       {"stackability", node.stackability},
                       {"energy", node.energy}});
  document["session"] = session_file(options).string();
  document["target"] = session.requirements.target;
  document["current"] = history.current;
  document["designs"] = designs;
}

/// Prints the address, and serves until the last page has left.
std::optional<editing::Document> serve(const EditCommandOptions& options, EditingRoom& room) {
  (options.common.json_on_stdout() ? std::cerr : std::cout) << room.address() << std::endl;
  if (!options.common.quiet)
    std::cerr << "stackabilize: open this address in a browser on this machine. "
              << (options.keep_open ? "End with Ctrl-C.\n"
                                    : "The editor ends when its last page is closed.\n");
  if (!options.no_browser) open_browser(room.address());
  return room.run();
}

WebOptions web_options(const EditCommandOptions& options) {
  WebOptions web;
  web.port = static_cast<unsigned short>(options.port);
  web.keep_open = options.keep_open;
  return web;
}

/// Leads a participant through the tasks of a study; MODEL is its plan.
int run_study(const EditCommandOptions& options) {
  if (options.session || options.fresh || options.direction || options.target || options.room.copies ||
      options.common.json)
    throw UsageError(
        "--study goes with none of --session, --fresh, --direction, --target, --copies and --json");
  const ThreadLimit limit(options.common);
  SessionLocks locks;
  RoomOptions room_options;
  room_options.lock = locks.take(*options.study);  // of two programs, each would have the same participant
  room_options.study = study_options(options);
  room_options.session.suggests = false;
  // Models that cannot be read are refused now, not in the middle of a study.
  std::optional<editing::Document> first;
  for (const editing::StudyPlanTask& task : room_options.study->plan.tasks) {
    editing::Document document = task_document(options, task);
    if (!first) first = std::move(document);
  }
  room_options.name = "Study";
  room_options.stem = "study";
  EditingRoom room(std::move(*first), std::move(room_options), web_options(options));
  serve(options, room);
  return status_done;
}

/// Waits for a mesh file that is dropped onto the page. Throws UsageError for options that say something of
/// MODEL.
int run_without_model(const CLI::App& command, const EditCommandOptions& options) {
  std::optional<std::string> given = given_mesh_option(command);
  for (const char* option :
       {"--study", "--session", "--fresh", "--direction", "--target", "--copies", "--json"})
    if (!given && command.count(option) > 0) given = option;
  if (given) throw UsageError(*given + " needs MODEL");
  const ThreadLimit limit(options.common);
  SessionLocks locks;
  RoomOptions room_options;
  room_options.open = [&options, &locks](const std::string& name, const std::string& bytes) {
    return dropped_model(options, locks, name, bytes);
  };
  EditingRoom room(std::nullopt, std::move(room_options), web_options(options));
  serve(options, room);
  return status_done;
}

int run_edit_command(const CLI::App& command, const EditCommandOptions& options) {
  const Stopwatch watch;
  check(options.room, options.target);
  if (options.common.model.empty()) return run_without_model(command, options);
  const std::filesystem::path autosave = session_file(options);
  CommandFiles files{{{"--study", options.study}, {"--session", options.session}},
                     analysis_inputs(options.analysis)};
  if (!autosave.empty()) files.outputs.back().path = autosave.string();
  check_outputs(options.common, files);
  if (options.study) return run_study(options);
  const ThreadLimit limit(options.common);
  SessionLocks locks;
  RoomOptions room_options;
  room_options.lock = locks.take(autosave);
  std::optional<editing::Document> document;
  if (!options.fresh)
    document = saved_document({autosave, options.common.model, source_of(options),
                               "--fresh begins anew, --session names another file"},
                              options.measure);
  if (document) check_options_of_saved(command, options, *document);
  room_options.resumed = document.has_value();
  if (!document) document = fresh_document(command, options);
  set_wish(options, *document);
  Model model;
  model.name = options.common.model;
  model.shape = document->project.rest.shape;
  model.findings = inspect(model.shape);
  room_options.session.autosave = autosave;
  room_options.name = title_of(model);
  room_options.stem = stem_of(room_options.name);
  room_options.open = [&options, &locks](const std::string& name, const std::string& bytes) {
    return dropped_model(options, locks, name, bytes);
  };
  EditingRoom room(std::move(*document), std::move(room_options), web_options(options));
  const editing::Document last = *serve(options, room);
  if (options.common.json) {
    Json result = document_head(command, model);
    add_session(result, options, last);
    add_document_tail(result, options.common, model, watch);
    deliver(options.common, result, "");
  }
  return status_done;
}

}  // namespace

Command make_edit_command(CLI::App& program) {
  const auto options = std::make_shared<EditCommandOptions>();
  CLI::App* const command =
      add_command(program, "edit", "Open an editor in the browser: edits that make a shape stack better",
                  "stackabilize edit chair.obj\n\n"
                  "Prints the address of a page for a browser on this machine. Each change is saved in\n"
                  "MODEL.session.json, and the next start goes on from there.");
  add_common_options(*command, options->common);
  command->get_option("MODEL")->required(false)->description(
      "Mesh file (" + std::string(readable_extensions()) +
      "), - for stdin, or a project; without it the page asks for a file, and keeps it in this folder");
  add_analysis_options(*command, options->analysis);
  add_semantics_option(*command, options->measure.semantics);
  add_boxes_option(*command, options->measure.boxes);
  add_direction(*command, "--direction", options->direction,
                "Direction along which copies are stacked at first (default: 0 0 1)");
  add_number(*command, target_option("Stackability that is wanted (default: S at rest + 0.2)"),
             options->target);
  add_room_options(*command, options->room);
  constexpr int max_port = 65535;
  add_count(*command, {"--port", "Port on 127.0.0.1 (default: one that is free)", 0, max_port},
            options->port);
  command->add_option("--session", options->session, "File of the session (default: MODEL.session.json)")
      ->type_name("FILE");
  command
      ->add_option("--study", options->study,
                   "MODEL is the plan of a study (see the guide of the editor): lead its next participant "
                   "through the tasks, and append what happens to this CSV")
      ->type_name("FILE");
  command->add_flag("--fresh", options->fresh, "Begin anew, whatever was saved");
  command->add_flag("--keep-open", options->keep_open, "Go on when the last page was closed");
  command->add_flag("--no-browser", options->no_browser, "Only print the address");
  return {command, [command, options] { return run_edit_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
