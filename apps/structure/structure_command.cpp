#include <memory>

#include "apps/common/command.h"
#include "apps/common/output.h"
#include "apps/common/rendering.h"
#include "apps/common/structure_report.h"
#include "apps/common/structured_model.h"
#include "stackabilization/structure/relation_graph.h"

namespace stackabilization::apps {

namespace {

struct StructureCommandOptions {
  CommonOptions common;
  AnalysisArguments analysis;
  std::optional<std::string> picture;
  std::optional<std::string> save;
  std::optional<std::string> graph;
  std::optional<std::string> output;  ///< mesh file
};

int run_structure_command(const CLI::App& command, const StructureCommandOptions& options) {
  const Stopwatch watch;
  check_outputs(options.common, {{{"--output", options.output, OutputKind::mesh},
                                  {"--picture", options.picture, OutputKind::picture},
                                  {"--save", options.save, OutputKind::project},
                                  {"--graph", options.graph}},
                                 analysis_inputs(options.analysis)});
  if (options.picture) require_rendering();
  const ThreadLimit limit(options.common);
  const StructuredModel input = load_structured(command, options.common, options.analysis);

  Json document = document_head(command, input.model);
  add_structure(document, input.structured);
  add_document_tail(document, options.common, input.model, watch);
  if (options.save)
    write_text_output(options.common, *options.save,
                      project_text(Project{input.structured, input.history, input.space}));
  if (options.output) write_mesh_output(options.common, *options.output, input.structured.shape);
  if (options.graph) write_text_output(options.common, *options.graph, graphviz(input.structured.structure));
  if (options.picture) write_structure_picture({*options.picture, title_of(input.model)}, input.structured);
  const bool printed = options.save == "-" || options.graph == "-";
  deliver(options.common, document,
          printed                ? ""
          : options.common.quiet ? essential_structure(input.structured.structure)
                                 : structure_text(input.structured, input.model));
  return status_done;
}

}  // namespace

Command make_structure_command(CLI::App& program) {
  const auto options = std::make_shared<StructureCommandOptions>();
  CLI::App* const command = add_command(
      program, "structure", "Find the parts of a shape, what stands for them, and how they are related",
      "stackabilize structure chair.obj --picture chair.png --save chair.json");
  add_common_options(*command, options->common);
  add_analysis_options(*command, options->analysis);
  command
      ->add_option("--save", options->save, "Write a project file, to be corrected by hand and read as MODEL")
      ->type_name("PROJECT");
  add_mesh_output(*command, options->common, options->output, "the shape with its parts");
  command->add_option("--graph", options->graph, "Write the graph of the relations for Graphviz (.dot)")
      ->type_name("FILE");
  command->add_option("--picture", options->picture, "Draw parts, primitives and relations (.png or .svg)")
      ->type_name("FILE");
  return {command, [command, options] { return run_structure_command(*command, *options); },
          &options->common};
}

}  // namespace stackabilization::apps
