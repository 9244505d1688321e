#include <algorithm>
#include <memory>

#include "apps/common/command.h"
#include "apps/common/holding.h"
#include "apps/common/measurement.h"
#include "apps/common/output.h"
#include "apps/common/requirement_options.h"
#include "apps/common/values.h"
#include "stackabilization/envelope/contacts.h"

namespace stackabilization::apps {

namespace {

constexpr std::size_t listed_supports = 6;

struct HoldCommandOptions {
  CommonOptions common;
  int copies = 2;
  std::optional<Eigen::Vector3d> direction;
  ContactSemantics semantics = ContactSemantics::solid;
  std::optional<double> friction;
  std::optional<Length> side_gap;
};

void add_support_lines(TextTable& table, const std::vector<ContactRegion>& regions,
                       const std::vector<std::string>& names) {
  for (std::size_t k = 0; k < std::min(regions.size(), listed_supports); ++k)
    table.add(
        k == 0 ? "Rests" : "",
        names[static_cast<std::size_t>(regions[k].lower_part)] + " on " +
            names[static_cast<std::size_t>(regions[k].upper_part)],
        regions[k].type == ContactType::ring ? "all around" : "at " + point_text(regions[k].upper_centre));
  if (regions.size() > listed_supports) table.add("", "...", "all of them with --json");
}

int run_hold_command(const CLI::App& command, const HoldCommandOptions& options) {
  const Stopwatch watch;
  check_outputs(options.common, {});
  const Direction direction(options.direction.value_or(Eigen::Vector3d::UnitZ()));
  const ThreadLimit limit(options.common);
  const Model model = load_model(options.common);
  const Shape& shape = model.shape;
  HoldingOptions asked;
  asked.copies = options.copies;
  asked.semantics = options.semantics;
  asked.friction = options.friction.value_or(default_friction);
  if (options.side_gap) asked.side_gap = options.side_gap->in(shape.unit);
  const Holding holding = named(model, [&] { return holding_of(shape, direction, asked); });
  const Contacts contacts = contact_regions(
      shape, direction, {.semantics = options.semantics, .band = StaticStabilityOptions().band});

  Json document = document_head(command, model);
  document["direction"] = to_json(direction.vector());
  document["semantics"] = name_of(options.semantics);
  document["contacts"] = to_json(contacts.regions, shape.part_names);
  document.update(to_json(holding, shape.part_names));
  add_document_tail(document, options.common, model, watch);
  TextTable table;
  add_model_line(table, model);
  table.add("Direction", vector_text(direction.vector()), "copies are lifted along it");
  add_support_lines(table, contacts.regions, shape.part_names);
  add_holding_lines(table, holding, shape.part_names, shape.unit);
  deliver(options.common, document,
          options.common.quiet ? exact_digits(holding.stability.tipping_degrees) + "\n" : table.text());
  return holding.stability.stands ? status_done : status_no;
}

}  // namespace

Command make_hold_command(CLI::App& program) {
  const auto options = std::make_shared<HoldCommandOptions>();
  CLI::App* const command =
      add_command(program, "hold", "Say whether a stack of copies stands, slides, centres itself or jams",
                  "stackabilize hold chair.obj -n 10 --friction 0.2");
  add_common_options(*command, options->common);
  add_count(*command, {"-n", "Number of copies (default: 2)", 2, max_copies}, options->copies);
  add_direction(*command, "--direction", options->direction, "Stacking direction (default: 0 0 1)");
  add_semantics_option(*command, options->semantics);
  add_number(*command, friction_option("Coefficient of friction between copies (default: 0.3)"),
             options->friction);
  add_length(*command,
             {"--side-gap",
              "Walls that are closer than this across the direction count as tight (default: 0.1 % of the "
              "diagonal)"},
             options->side_gap);
  return {command, [command, options] { return run_hold_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
