#include "apps/common/common_options.h"

#include <tbb/global_control.h>

#include "apps/common/values.h"
#include "apps/common/version.h"

namespace stackabilization::apps {

namespace {

/// More than any machine has; a larger number is a typing error.
constexpr int max_threads = 1024;

const Count& threads_option() {
  static const Count option = {"--threads", "Threads to use (default: all); never changes a result", 1,
                               max_threads};
  return option;
}

void add_reading_options(CLI::App& command, ReadOptions& read) {
  const Choices<Format> formats = {{"obj", Format::obj}, {"off", Format::off},      {"ply", Format::ply},
                                   {"stl", Format::stl}, {"3mf", Format::three_mf}, {"gltf", Format::gltf}};
  add_choice(command, "--format", read.format, formats,
             "Format of MODEL (default: its extension, or its content)");
  add_choice(command, "--unit", read.unit, unit_choices(),
             "Unit of the coordinates (default: what the file states)");
  add_choice(command, "--up", read.up, axis_choices(),
             "Axis of the file that points up; it becomes z, also in directions (default: z; glTF: y)");
  const auto take_labels = [&read](const std::string& path) { read.labels = path; };
  command
      .add_option_function<std::string>("--labels", take_labels,
                                        "Part labels, .seg or one per line and triangle")
      ->type_name("FILE");
}

}  // namespace

CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& description,
                      const std::string& example) {
  CLI::App* const command = program.add_subcommand(name, description);
  command->footer("Example:\n  " + example);
  command->set_version_flag("--version", version_text(), "Print the version and exit");
  return command;
}

void add_common_options(CLI::App& command, CommonOptions& common) {
  common.command = &command;
  command
      .add_option("MODEL", common.model,
                  "Mesh file (" + std::string(readable_extensions()) + ") or - for stdin")
      ->type_name("")
      ->required();
  add_reading_options(command, common.read);
  command
      .add_option("--json", common.json,
                  "Write the result as JSON; - is stdout, and then the only thing on it")
      ->type_name("FILE");
  command.add_flag("--quiet", common.quiet, "Print the essential numbers only");
  command.add_flag("--no-timing", common.no_timing, "Leave the field seconds out of the JSON");
  add_count(command, threads_option(), common.threads);
  add_count(command, {"--seed", "Accepted for scripts: nothing here depends on chance"}, common.seed);
}

void add_mesh_output(CLI::App& command, CommonOptions& common, std::optional<std::string>& output,
                     const std::string& what) {
  command
      .add_option("-o,--output", output,
                  "Write " + what + " as a mesh (" + std::string(writable_extensions()) + ")")
      ->type_name("FILE");
  add_choice(command, "--to-unit", common.to_unit, unit_choices(),
             "Unit of the mesh written (default: that of MODEL)");
}

int parse_threads(const std::string& text) {
  return static_cast<int>(parse_count(threads_option(), text));
}

void add_semantics_option(CLI::App& command, ContactSemantics& semantics) {
  const Choices<ContactSemantics> choices = {{"solid", ContactSemantics::solid},
                                             {"closed", ContactSemantics::closed}};
  add_choice(command, "--semantics", semantics, choices,
             "solid: walls may slide along each other; closed: touching counts, for sheets (default: solid)");
}

void add_boxes_option(CLI::App& command, BoxModel& boxes) {
  const Choices<BoxModel> choices = {{"oriented", BoxModel::oriented}, {"frame", BoxModel::frame}};
  add_choice(
      command, "--boxes", boxes, choices,
      "oriented: minimal boxes, whatever the pose; frame: boxes along the file's axes (default: oriented)");
}

struct ThreadLimit::Data {
  explicit Data(int threads)
      : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(const CommonOptions& common) {
  if (common.threads > 0) data_ = std::make_unique<Data>(common.threads);
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace stackabilization::apps
