#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>

#include "apps/command.h"
#include "apps/editor/room.h"
#include "apps/output.h"
#include "apps/requirement_options.h"
#include "apps/structured_model.h"
#include "apps/values.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/fingerprint.h"
#include "stackabilization/io/read_file.h"

namespace stackabilization::apps {

namespace {

struct EditCommandOptions {
  CommonOptions common;
  AnalysisArguments analysis;
  StackabilityOptions measure;
  std::optional<Eigen::Vector3d> direction;
  std::optional<double> target;
  std::optional<std::string> session;
  int port = 0;
  bool fresh = false, keep_open = false, no_browser = false;
};

std::filesystem::path session_file(const EditCommandOptions& options) {
  if (options.session) return *options.session;
  if (options.common.model == "-") return {};
  return options.common.model + ".session.json";
}

/// A hash of MODEL, so that a session is not gone on with for another shape.
std::string source_of(const EditCommandOptions& options) {
  if (options.common.model == "-") return "";
  Fingerprint fingerprint;
  fingerprint.add(std::string_view(read_file(options.common.model)));
  return std::to_string(fingerprint.value());
}

/// What was saved of MODEL; nothing if there is no such file. Throws UsageError if it is of another shape.
std::optional<editing::Document> saved_document(const EditCommandOptions& options) {
  const std::filesystem::path file = session_file(options);
  std::error_code error;
  if (options.fresh || file.empty() || !std::filesystem::exists(file, error)) return std::nullopt;
  editing::Document document = editing::document_of_text(read_file(file), file.string(), options.measure);
  if (document.source != source_of(options))
    throw UsageError(options.common.model + " is not the file that " + file.string() +
                     " was made of: --fresh begins anew, --session names another file");
  return document;
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

int run_edit_command(const CLI::App& command, const EditCommandOptions& options) {
  const Stopwatch watch;
  const std::filesystem::path autosave = session_file(options);
  CommandFiles files{{}, analysis_inputs(options.analysis)};
  if (!autosave.empty()) files.outputs = {{"--session", autosave.string(), OutputKind::text}};
  check_outputs(options.common, files);
  const ThreadLimit limit(options.common);
  std::optional<editing::Document> document = saved_document(options);
  RoomOptions room_options;
  room_options.resumed = document.has_value();
  if (!document) document = fresh_document(command, options);
  if (options.target) document->requirements.target = *options.target;
  Model model;
  model.name = options.common.model;
  model.shape = document->project.rest.shape;
  model.findings = inspect(model.shape);
  room_options.session.autosave = autosave;
  room_options.name = title_of(model);
  room_options.stem = room_options.name.substr(0, room_options.name.find('.'));
  WebOptions web;
  web.port = static_cast<unsigned short>(options.port);
  web.keep_open = options.keep_open;
  EditingRoom room(std::move(*document), std::move(room_options), web);
  (options.common.json_on_stdout() ? std::cerr : std::cout) << room.address() << std::endl;
  if (!options.common.quiet)
    std::cerr << "stackabilize: open this address in a browser on this machine. "
              << (options.keep_open ? "End with Ctrl-C.\n"
                                    : "The editor ends when its last page is closed.\n");
  if (!options.no_browser) open_browser(room.address());
  const editing::Document last = room.run();
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
  add_analysis_options(*command, options->analysis);
  add_semantics_option(*command, options->measure.semantics);
  add_boxes_option(*command, options->measure.boxes);
  add_direction(*command, "--direction", options->direction,
                "Direction along which copies are stacked at first (default: 0 0 1)");
  add_number(*command, target_option("Stackability that is wanted (default: S at rest + 0.2)"),
             options->target);
  constexpr int max_port = 65535;
  add_count(*command, {"--port", "Port on 127.0.0.1 (default: one that is free)", 0, max_port},
            options->port);
  command->add_option("--session", options->session, "File of the session (default: MODEL.session.json)")
      ->type_name("FILE");
  command->add_flag("--fresh", options->fresh, "Begin anew, whatever was saved");
  command->add_flag("--keep-open", options->keep_open, "Go on when the last page was closed");
  command->add_flag("--no-browser", options->no_browser, "Only print the address");
  return {command, [command, options] { return run_edit_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
