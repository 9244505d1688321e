#include "apps/common/structured_model.h"

#include <array>
#include <filesystem>
#include <optional>

#include "apps/common/caller.h"
#include "apps/common/interrupt.h"
#include "apps/common/progress.h"
#include "apps/common/values.h"
#include "stackabilization/core/part_names.h"
#include "stackabilization/structure/ctrl_grp_files.h"
#include "stackabilization/structure/seeds.h"

namespace stackabilization::apps {

namespace {

/// Options that say how a mesh is read and analysed; a project file is neither.
constexpr std::array<const char*, 13> mesh_options = {
    "--format",      "--unit",  "--up",        "--labels",   "--segmentation",
    "--segments",    "--seeds", "--primitive", "--sections", "--symmetry-tolerance",
    "--joint-reach", "--ctrl",  "--grp"};

const Choices<PrimitiveKind>& primitive_kinds() {
  static const Choices<PrimitiveKind> kinds = {{"cuboid", PrimitiveKind::cuboid},
                                               {"cylinder", PrimitiveKind::cylinder}};
  return kinds;
}

/// "leg_1=cylinder"; the part "all" stands for every part.
void take_primitive(AnalysisOptions& options, const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const std::string name = text.substr(0, equals);
  for (const auto& [word, kind] : primitive_kinds()) {
    if (equals == std::string::npos || name.empty() || text.substr(equals + 1) != word) continue;
    if (name == "all")
      options.fit.kind = kind;
    else
      options.kinds[name] = kind;
    return;
  }
  throw UsageError("--primitive expects PART=" + choice_names(primitive_kinds()) +
                   " or all=" + choice_names(primitive_kinds()) + ", found '" + text + "'");
}

void add_segmentation_options(CLI::App& command, AnalysisArguments& arguments) {
  SegmentationOptions& segmentation = arguments.options.segmentation;
  const Choices<SegmentationMethod> methods = {
      {"given", SegmentationMethod::given},           {"members", SegmentationMethod::members},
      {"whole", SegmentationMethod::whole},           {"components", SegmentationMethod::components},
      {"primitives", SegmentationMethod::primitives}, {"shape-diameter", SegmentationMethod::shape_diameter},
      {"automatic", SegmentationMethod::automatic}};
  add_choice(
      command, "--segmentation", segmentation.method, methods,
      "How the mesh is cut into parts (default: automatic: given parts and their members, else components "
      "and theirs, else primitives; a body of revolution stays whole)");
  add_count(command,
            {"--segments", "Parts to cut every component into (default: as many as it has)", 1, 1000},
            segmentation.parts);
  command
      .add_option("--seeds", arguments.seeds, "Triangles marked by hand: a part and its triangles per line")
      ->type_name("FILE");
}

/// The options of the library: those that are left out keep its defaults.
AnalysisOptions analysis_options(const AnalysisArguments& arguments) {
  AnalysisOptions options = arguments.options;
  options.symmetry.tolerance = arguments.symmetry_tolerance.value_or(options.symmetry.tolerance);
  options.joints.reach = arguments.joint_reach.value_or(options.joints.reach);
  return options;
}

/// The structure as the authors of the paper wrote it down.
StructuredShape authored(const Shape& shape, const AnalysisArguments& arguments) {
  CtrlGrpFiles files;
  if (arguments.controllers) files.controls = *arguments.controllers;
  if (arguments.relations) files.groups = *arguments.relations;
  return {shape, read_ctrl_grp(shape, files)};
}

const char* words_for(AnalysisStep step) {
  switch (step) {
    case AnalysisStep::parts:
      return "Finding parts";
    case AnalysisStep::primitives:
      return "Fitting primitives";
    case AnalysisStep::symmetries:
      return "Looking for symmetries";
    case AnalysisStep::joints:
      break;
  }
  return "Looking for joints";
}

/// The analysis, with a bar for each of its steps.
StructuredShape analysed_with_bar(const Shape& shape, AnalysisOptions options, const Caller* caller) {
  std::optional<ProgressBar> bar;
  options.progress = [&bar, caller, shown = std::optional<AnalysisStep>()](AnalysisStep step,
                                                                           double fraction) mutable {
    if (shown != step) bar.emplace(words_for(step), caller);
    shown = step;
    bar->show(fraction);
    if (caller && caller->stopped && caller->stopped()) throw Interrupted();
  };
  return analyse_structure(shape, options);
}

StructuredModel analysed(const CommonOptions& common, const AnalysisArguments& arguments,
                         const std::optional<PartBounds>& bounds) {
  if (arguments.seeds && arguments.options.segmentation.method != SegmentationMethod::automatic)
    throw UsageError("--seeds says what the parts are, so it does not go with --segmentation");
  StructuredModel result;
  result.model = load_model(common);
  AnalysisOptions options = analysis_options(arguments);
  if (bounds) {
    options.max_parts = bounds->max_parts;
    options.joints.max_pairs = bounds->max_pairs;
  }
  Shape& shape = result.model.shape;
  if (arguments.seeds) {
    shape = segment(shape, read_seeds(*arguments.seeds, shape));
    options.segmentation.method = SegmentationMethod::given;
  }
  result.structured =
      arguments.controllers || arguments.relations
          ? authored(shape, arguments)
          : named(result.model, [&] { return analysed_with_bar(shape, options, common.caller); });
  shape = result.structured.shape;
  return result;
}

/// A project of the caller; nothing: MODEL is a mesh or a file.
std::optional<Project> project_of_caller(const CommonOptions& common) {
  if (!common.caller) return std::nullopt;
  const auto found = common.caller->projects.find(common.model);
  if (found == common.caller->projects.end()) return std::nullopt;
  return project_with_history(found->second, common.model);
}

}  // namespace

Choices<DeformationKind> deformation_choices() {
  Choices<DeformationKind> choices;
  for (const DeformationKind kind : deformation_kinds()) choices.emplace_back(name_of(kind), kind);
  return choices;
}

void add_analysis_options(CLI::App& command, AnalysisArguments& arguments) {
  add_segmentation_options(command, arguments);
  const auto take = [&arguments](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) take_primitive(arguments.options, text);
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--primitive", take,
          "Force the primitive of a part, or of all (default: the better fit); repeatable")
      ->type_size(1)
      ->allow_extra_args(false)
      ->type_name("PART=cuboid|cylinder");
  add_count(command, {"--sections", "Cross-sections of a generalized cylinder (default: 24)", 4, 1000},
            arguments.options.fit.sections);
  add_number(command,
             {"--symmetry-tolerance",
              "Largest deviation of a symmetry, fraction of the diagonal (default: 0.01)", 0, 1, true},
             arguments.symmetry_tolerance);
  add_number(command,
             {"--joint-reach",
              "Parts that come nearer than this meet, fraction of the diagonal (default: 0.01)", 0, 1, true},
             arguments.joint_reach);
  command
      .add_option("--ctrl", arguments.controllers,
                  "Primitives from a .ctrl file of the paper's authors; the structure is not analysed")
      ->type_name("FILE");
  command
      .add_option("--grp", arguments.relations,
                  "Relations from a .grp file of the paper's authors; the structure is not analysed")
      ->type_name("FILE");
}

std::vector<InputFile> analysis_inputs(const AnalysisArguments& arguments) {
  std::vector<InputFile> inputs;
  if (arguments.seeds) inputs.push_back({"the seeds", *arguments.seeds});
  if (arguments.controllers) inputs.push_back({"the primitives", *arguments.controllers});
  if (arguments.relations) inputs.push_back({"the relations", *arguments.relations});
  return inputs;
}

bool is_project(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".json" || extension == ".JSON";
}

std::optional<std::string> given_mesh_option(const CLI::App& command) {
  for (const char* option : mesh_options)
    if (command.count(option) > 0) return option;
  return std::nullopt;
}

StructuredModel load_structured(const CLI::App& command, const CommonOptions& common,
                                const AnalysisArguments& arguments, const std::optional<PartBounds>& bounds) {
  const std::optional<Project> in_memory = project_of_caller(common);
  if (!in_memory && !is_project(common.model)) return analysed(common, arguments, bounds);
  if (const auto option = given_mesh_option(command))
    throw UsageError(*option +
                     " does not go with a project file, which holds shape and structure: " + common.model);
  StructuredModel result;
  Project project = in_memory ? *in_memory : read_project_with_history(common.model);
  result.structured = std::move(project.rest);
  result.history = std::move(project.history);
  result.space = project.space;
  result.model.name = common.model;
  result.model.shape = result.structured.shape;
  check_unit(common, result.model.shape);
  result.model.findings = inspect(result.model.shape);
  return result;
}

std::vector<int> parts_named(const std::string& option, const std::vector<std::string>& names,
                             const Shape& shape) {
  try {
    return stackabilization::parts_named(shape, names);
  } catch (const InputError& error) {
    throw UsageError(option + " expects the name of a part, and " + error.what());
  }
}

}  // namespace stackabilization::apps
