#include <memory>

#include "apps/common/command.h"
#include "apps/common/measurement.h"
#include "apps/common/output.h"
#include "apps/common/values.h"
#include "stackabilization/mesh/convex_hull.h"

namespace stackabilization::apps {

namespace {

struct GapCommandOptions {
  CommonOptions common;
  std::string above;
  std::optional<Eigen::Vector3d> direction;
  ContactSemantics semantics = ContactSemantics::solid;
};

/// How far ABOVE can come down along the direction, model units; negative: it is in the way by so much.
std::optional<double> gap_of(const Separation& separation) {
  return separation.blocked ? std::optional(0 - separation.length) : std::nullopt;
}

void add_gap(Json& document, const GradientQuery& query, ContactSemantics semantics) {
  const Separation& separation = query.separation;
  document["gap"] = to_json(gap_of(separation));
  document["exact"] = separation.blocked ? to_json(Rational() - separation.value) : Json(nullptr);
  document["witness"] = separation.blocked ? to_json(separation.witness) : Json(nullptr);
  document["gradient"] =
      separation.blocked ? to_json(separation_gradients(query, {.semantics = semantics})) : Json(nullptr);
}

std::string gap_text(const Model& below, const Model& above, const Separation& separation,
                     const Direction& direction) {
  const Unit unit = below.shape.unit;
  TextTable table;
  add_model_line(table, below);
  table.add("Above", display_name(above) + ": " + brief(above.findings));
  table.add("Direction", vector_text(direction.vector()));
  const std::optional<double> gap = gap_of(separation);
  if (!gap) {
    table.add("Gap", "none", "they pass each other along the direction, whatever their distance");
    return table.text();
  }
  table.add("Gap", quantity(*gap, unit),
            *gap >= 0 ? "so far it can come down before they touch"
                      : "it overlaps or lies below: it is free of it when lifted by as much");
  const Witness& witness = separation.witness;
  const double size = HullSupport(below.shape).extent(direction);
  table.add("Touching", "triangle " + std::to_string(witness.upper_triangle),
            "of " + title_of(below) + " at " + point_text(witness.upper_point, size));
  table.add("", "triangle " + std::to_string(witness.lower_triangle),
            "of " + title_of(above) + " at " + point_text(witness.lower_point, size));
  return table.text();
}

int run_gap_command(const CLI::App& command, const GapCommandOptions& options) {
  const Stopwatch watch;
  check_outputs(options.common, {{}, {{"ABOVE", options.above}}});
  refuse_option(options.common.model == "-" && options.above == "-", "MODEL",
                "and ABOVE cannot both be standard input");
  const Direction direction(options.direction.value_or(Eigen::Vector3d::UnitZ()));
  const ThreadLimit limit(options.common);
  const Model below = load_model(options.common), above = load_other_model(options.common, options.above);
  check_same_unit(below, above, "ABOVE");
  SeparationOptions separating;
  separating.semantics = options.semantics;
  const SeparationTree tree_below(below.shape), tree_above(above.shape);
  const Separation found = separation(tree_below, tree_above, direction, separating);

  Json document = document_head(command, below);
  document["above"] = above.name;
  document["direction"] = to_json(direction.vector());
  document["semantics"] = name_of(options.semantics);
  add_gap(document, {tree_below, tree_above, direction, found}, options.semantics);
  add_document_tail(document, options.common, below, watch);
  const std::optional<double> gap = gap_of(found);
  deliver(options.common, document,
          options.common.quiet ? (gap ? exact_digits(*gap) : "none") + "\n"
                               : gap_text(below, above, found, direction));
  return status_done;
}

}  // namespace

Command make_gap_command(CLI::App& program) {
  const auto options = std::make_shared<GapCommandOptions>();
  CLI::App* const command =
      add_command(program, "gap", "Say how far one shape is above another one along a direction",
                  "stackabilize gap crate.obj bowl.obj --direction 0 0 1");
  add_common_options(*command, options->common);
  command->add_option("ABOVE", options->above, "Mesh file of the shape that comes down onto MODEL")
      ->type_name("FILE")
      ->required();
  add_direction(*command, "--direction", options->direction,
                "Direction from MODEL to ABOVE, exact doubles (default: 0 0 1)");
  add_semantics_option(*command, options->semantics);
  return {command, [command, options] { return run_gap_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
