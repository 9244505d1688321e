#include "apps/common/command.h"
#include "apps/common/measurement.h"
#include "apps/common/output.h"
#include "apps/common/rendering.h"
#include "apps/stack/stack_run.h"
#include "stackabilization/stacking/nest.h"

namespace stackabilization::apps {

namespace {

void add_nest(Json& document, const StackCommandOptions& options, const NestResult& result) {
  document["semantics"] = name_of(options.stackability.semantics);
  document["boxes"] = name_of(options.stackability.boxes);
  document["n"] = 2;
  document["offset"] = result.offset_length;
  document["exact_offset"] = to_json(result.offset);
  document["offsets"] = {0.0, result.offset_length};
  document["on_floor"] = result.on_floor;
  document["witness"] =
      !result.on_floor && result.separation.blocked ? to_json(result.separation.witness) : Json(nullptr);
  document["container_height"] = result.container_height;
  document["content_height"] = result.content_height;
  document["height"] = result.total_height;
  document["saving"] = result.saving;
  document["box_volume"] = result.box_volume;
  document["stack_volume"] = result.stack_box_volume;
  document["stackability"] = to_json(result.stackability());
  document["conflicts"] = Json::array();
}

std::string nest_text(const Model& content, const Model& container, const NestResult& result) {
  const Unit unit = content.shape.unit;
  TextTable table;
  add_model_line(table, content);
  table.add("Into", container.name + ": " + brief(container.findings));
  table.add("Offset", quantity(result.offset_length, unit),
            result.on_floor ? "lift from where its file puts it; it stands on the floor"
                            : "lift from where its file puts it; it rests on the container");
  table.add("Height", quantity(result.total_height, unit),
            "of both; apart " + quantity(result.container_height, unit) + " and " +
                quantity(result.content_height, unit));
  return table.text() + "Nesting saves " + quantity(result.saving, unit) + " of height.\n";
}

}  // namespace

int run_nest(const CLI::App& command, const StackCommandOptions& options) {
  const Stopwatch watch;
  const Direction direction = options.stacking_direction();
  const ThreadLimit limit(options.common);
  const Model content = load_model(options.common),
              container = load_other_model(options.common, *options.into);
  check_same_unit(content, container, "--into");
  const Play play = play_of(options, content.shape.unit);
  NestOptions nesting;
  nesting.semantics = options.stackability.semantics;
  nesting.clearance = play.clearance;
  nesting.play = play.lateral;
  nesting.boxes = options.stackability.boxes;
  const NestResult result = nest(container.shape, content.shape, direction, nesting);

  Json document = document_head(command, content);
  document["into"] = container.name;
  document["direction"] = to_json(direction.vector());
  document["clearance"] = play.clearance;
  document["lateral_clearance"] = play.lateral;
  add_nest(document, options, result);
  add_document_tail(document, options.common, content, watch);
  if (options.output)
    write_mesh_output(options.common, *options.output, concatenate(container.shape, result.content));
  if (options.picture) {
    const std::string note = "nesting saves " + quantity(result.saving, content.shape.unit) + " of height";
    write_stack_picture({*options.picture, title_of(content) + " in " + title_of(container)},
                        {{container.shape, result.content}, direction, {note}});
  }
  deliver(options.common, document,
          options.common.quiet ? exact_digits(result.offset_length) + "\n"
                               : nest_text(content, container, result));
  return status_done;
}

}  // namespace stackabilization::apps
