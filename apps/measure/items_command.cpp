#include <algorithm>
#include <filesystem>
#include <memory>

#include "apps/common/caller.h"
#include "apps/common/command.h"
#include "apps/common/measurement.h"
#include "apps/common/output.h"
#include "apps/common/values.h"
#include "apps/common/version.h"
#include "stackabilization/core/text.h"
#include "stackabilization/core/utf8.h"
#include "stackabilization/io/format.h"
#include "stackabilization/stacking/load_item.h"

namespace stackabilization::apps {

namespace {

struct ItemsCommandOptions {
  CommonOptions common;
  std::vector<std::string> more;
  std::optional<Eigen::Vector3d> direction;
  std::optional<Length> clearance, lateral_clearance, step;
  int copies = 1;
  ContactSemantics semantics = ContactSemantics::solid;
  std::optional<std::string> table;
};

struct Item {
  Model model;
  double step = 0;  ///< a whole unit, units of the model
  LoadItem numbers;
};

bool is_mesh_file(const std::filesystem::path& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return false;
  try {
    return format_of_extension(path) != Format::vtp;
  } catch (const InputError&) {
    return false;
  }
}

/// The meshes of a folder by name.
std::vector<std::string> meshes_in(const std::string& folder) {
  std::error_code unreadable;
  std::vector<std::string> found;
  for (std::filesystem::directory_iterator entry(folder, unreadable), end; !unreadable && entry != end;
       entry.increment(unreadable))
    if (is_mesh_file(entry->path())) found.push_back(entry->path().string());
  if (unreadable) throw InputError(folder + ": the folder cannot be read: " + unreadable.message());
  if (found.empty())
    throw InputError(folder + ": expected a folder with meshes (" + std::string(readable_extensions()) +
                     "), found none");
  std::sort(found.begin(), found.end());
  for (const std::string& name : found)
    if (!is_utf8(name))
      throw InputError(folder + ": expected names of meshes in UTF-8, found " + in_quotes(name));
  return found;
}

/// Appends a mesh, or the meshes of a folder.
void add_meshes(std::vector<std::string>& meshes, const std::string& path, const Caller* caller) {
  std::error_code unknown;
  const bool is_in_memory = caller && caller->meshes.count(path) > 0;
  if (path == "-" || is_in_memory || !std::filesystem::is_directory(path, unknown)) {
    meshes.push_back(path);
    return;
  }
  const std::vector<std::string> found = meshes_in(path);
  meshes.insert(meshes.end(), found.begin(), found.end());
}

std::vector<std::string> meshes_of(const ItemsCommandOptions& options) {
  std::vector<std::string> meshes;
  const Caller* const caller = options.common.caller;
  add_meshes(meshes, options.common.model, caller);
  for (const std::string& path : options.more) add_meshes(meshes, path, caller);
  refuse_option(std::count(meshes.begin(), meshes.end(), "-") > 1, "MODEL", "can be standard input once");
  refuse_option(meshes.size() > 1 && options.common.read.format, "--format", "is for one mesh");
  refuse_option(meshes.size() > 1 && options.common.read.labels, "--labels", "are of one mesh");
  return meshes;
}

/// Throws InputError for what a planner cannot count: a sheet seen edge-on, or one whose copies add no
/// height.
void check_extents(const LoadItem& numbers, const Model& model) {
  if (numbers.width == 0)
    throw InputError(display_name(model) +
                     ": seen along the direction it has no area, and an item needs some");
  if (numbers.increment == 0)
    throw InputError(display_name(model) +
                     ": further copies add no height, for it is a sheet: give its thickness as --clearance");
}

LoadItem measured_item(const ItemsCommandOptions& options, const Model& model, double step) {
  const Unit unit = model.shape.unit;
  StackabilityOptions measure;
  measure.semantics = options.semantics;
  measure.flat_shapes = FlatShapes::measure;
  measure.clearance = length_in(options.clearance, unit);
  measure.play = length_in(options.lateral_clearance, unit);
  const Direction direction(options.direction.value_or(Eigen::Vector3d::UnitZ()));
  const StackabilitySolver solver = named(model, [&] { return StackabilitySolver(model.shape, measure); });
  try {
    return load_item(solver, direction, step);
  } catch (const UsageError& error) {
    throw UsageError("--step: " + display_name(model) + ": " + error.what());
  }
}

Item item_of(const ItemsCommandOptions& options, const CommonOptions& common) {
  const Length millimetre = {1, Unit::millimetre, "1mm"};
  Item item;
  item.model = load_model(common);
  if (!options.step && item.model.shape.unit == Unit::unknown)
    throw UsageError(display_name(item.model) +
                     " is in an unknown unit: say it with --unit, or a whole unit of the table with --step");
  item.step = options.step.value_or(millimetre).in(item.model.shape.unit);
  item.numbers = measured_item(options, item.model, item.step);
  check_extents(item.numbers, item.model);
  return item;
}

/// A name as a field of a table that planners split at every comma.
std::string field_of(std::string name) {
  for (char& c : name)
    if (c == ',' || c == '"' || static_cast<unsigned char>(c) < ' ') c = '_';
  return name;
}

std::string csv_text(const std::vector<Item>& items, int copies) {
  std::string text =
      "X,Y,Z,COPIES,ROTATION_XYZ,ROTATION_YXZ,ROTATION_ZYX,ROTATION_YZX,ROTATION_XZY,ROTATION_ZXY,"
      "STACKABILITY_ID,NESTING_HEIGHT,INCREMENT,NAME\n";
  const auto add = [&text](std::int64_t number) { text += std::to_string(number) + ","; };
  for (std::size_t k = 0; k < items.size(); ++k) {
    const LoadItem& item = items[k].numbers;
    for (const std::int64_t number : {item.length, item.width, item.height, std::int64_t{copies}})
      add(number);
    text += "1,1,0,0,0,0,";  // it stays upright
    for (const std::int64_t number : {static_cast<std::int64_t>(k), item.nesting_height, item.increment})
      add(number);
    text += field_of(title_of(items[k].model)) + "\n";
  }
  return text;
}

Json item_json(const Item& item) {
  return {{"model", item.model.name},
          {"unit", to_json(item.model.shape.unit)},
          {"step", item.step},
          {"length", item.numbers.length},
          {"width", item.numbers.width},
          {"height", item.numbers.height},
          {"nesting_height", item.numbers.nesting_height},
          {"increment", item.numbers.increment},
          {"findings", to_json(item.model.findings)}};
}

std::string items_text(const std::vector<Item>& items, const std::string& step) {
  ColumnTable table({"model", "x", "y", "z", "nesting height", "each further copy adds"});
  for (const Item& item : items) {
    std::vector<std::string> cells = {title_of(item.model)};
    for (const std::int64_t number : {item.numbers.length, item.numbers.width, item.numbers.height,
                                      item.numbers.nesting_height, item.numbers.increment})
      cells.push_back(std::to_string(number));
    table.add(std::move(cells));
  }
  std::string text = "Lengths are whole numbers of " + step +
                     ", rounded so that no stack is higher than planned.\n" + table.text();
  for (const Item& item : items)
    if (item.model.findings.likely_unit)
      text += title_of(item.model) + ": " + brief(item.model.findings) + "\n";
  return text;
}

int run_items_command(const CLI::App& command, const ItemsCommandOptions& options) {
  const Stopwatch watch;
  const std::vector<std::string> meshes = meshes_of(options);
  CommonOptions common = options.common;
  common.model = meshes.front();
  CommandFiles files = {{{"--output", options.table}}};
  for (std::size_t k = 1; k < meshes.size(); ++k) files.inputs.push_back({"MODEL", meshes[k]});
  check_outputs(common, files);
  const ThreadLimit limit(common);
  std::vector<Item> items;
  for (const std::string& mesh : meshes) {
    common.model = mesh;
    items.push_back(item_of(options, common));
  }

  Json document = {{"command", command.get_name()}, {"version", version_number()}};
  document["direction"] = to_json(options.direction.value_or(Eigen::Vector3d::UnitZ()));
  document["semantics"] = name_of(options.semantics);
  document["items"] = Json::array();
  for (const Item& item : items) document["items"].push_back(item_json(item));
  if (!common.no_timing) document["seconds"] = watch.seconds();
  const std::string table = csv_text(items, options.copies);
  if (options.table) write_text_output(common, *options.table, table);
  const std::string text =
      common.quiet ? table : items_text(items, options.step ? options.step->text : "1mm");
  deliver(common, document, options.table == "-" ? "" : text);
  return status_done;
}

}  // namespace

Command make_items_command(CLI::App& program) {
  const auto options = std::make_shared<ItemsCommandOptions>();
  CLI::App* const command =
      add_command(program, "items", "Make the item table of a load planner, with the nesting heights",
                  "stackabilize items crates/ --unit mm --clearance 2mm -o items.csv");
  add_common_options(*command, options->common);
  command->add_option("MORE", options->more, "Further meshes; each may be a folder of meshes, as MODEL may")
      ->type_name("FILE");
  add_direction(*command, "--direction", options->direction,
                "Direction of stacking, upwards, exact doubles (default: 0 0 1)");
  add_length(*command, {"--clearance", "Air between copies along the direction (default: 0)"},
             options->clearance);
  add_length(*command, {"--lateral-clearance", "Sideways play that every contact allows (default: 0)"},
             options->lateral_clearance);
  add_length(*command, {"--step", "Length that the whole numbers of the table count (default: 1mm)", true},
             options->step);
  add_count(*command, {"--copies", "Copies of each item to be loaded (default: 1)", 1, max_copies},
            options->copies);
  add_semantics_option(*command, options->semantics);
  command->add_option("-o,--output", options->table, "Write the table (CSV; - is stdout)")->type_name("FILE");
  return {command, [command, options] { return run_items_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
