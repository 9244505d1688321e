#include <memory>

#include "apps/common/command.h"
#include "apps/common/model.h"
#include "apps/common/output.h"

namespace stackabilization::apps {

namespace {

struct InspectCommandOptions {
  CommonOptions common;
  bool self_intersections = false;
};

int run_inspect_command(const CLI::App& command, const InspectCommandOptions& options) {
  const Stopwatch watch;
  check_outputs(options.common);
  const ThreadLimit limit(options.common);
  using SelfIntersections = InspectOptions::SelfIntersections;
  const Model model = load_model(
      options.common, {options.self_intersections ? SelfIntersections::count : SelfIntersections::skip});

  Json document = document_head(command, model);
  document["part_names"] = model.shape.part_names;
  add_document_tail(document, options.common, model, watch);
  deliver(options.common, document,
          options.common.quiet ? brief(model.findings) + "\n" : report(model.findings));
  return status_done;
}

}  // namespace

Command make_inspect_command(CLI::App& program) {
  const auto options = std::make_shared<InspectCommandOptions>();
  CLI::App* const command =
      add_command(program, "inspect", "Say what is in a mesh file, and what is wrong with it",
                  "stackabilize inspect chair.obj --self-intersections");
  add_common_options(*command, options->common);
  command->add_flag("--self-intersections", options->self_intersections,
                    "Count the pairs of triangles that intersect (seconds on large meshes)");
  return {command, [command, options] { return run_inspect_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
