#include <filesystem>

#include "apps/rendering.h"
#include "apps/suggest_run.h"
#include "apps/text.h"
#include "stackabilization/shape/direction_text.h"
#include "stackabilization/shape/errors.h"

namespace stackabilization::apps {

namespace {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw OutputError("the folder " + folder.string() + " cannot be made" +
                      (error ? ": " + error.message() : ""));
}

std::string values_text(const Stackability& measured, const Energy& energy) {
  return "S " + stackability_text(measured.value) + "   E " + stackability_text(energy.value);
}

StructuredShape as_rest(const StructuredShape& rest, const Design& design) {
  StructuredShape result{design.shape, rest.structure};
  for (std::size_t k = 0; k < design.primitives.size(); ++k)
    result.structure.parts[k].primitive = design.primitives[k];
  return result;
}

}  // namespace

void write_suggestion_pictures(const SuggestRun& run, const SuggestCommandOptions& options,
                               const Model& model) {
  const std::filesystem::path folder = *options.pictures;
  make_folder(folder);
  const std::vector<std::string>& names = run.project.rest.shape.part_names;
  const StructuredShape before = as_rest(run.project.rest, run.design);
  DesignSheet sheet;
  sheet.direction = run.direction;
  sheet.notes = {direction_text(run.direction.vector()) + ", with contact regions in red"};
  sheet.tiles.push_back({run.design,
                         std::nullopt,
                         run.now.contacts,
                         {"now: " + values_text(run.now.measured, run.now.energy)}});
  const std::size_t count = std::min(run.possible(), static_cast<std::size_t>(options.top));
  for (std::size_t k = 0; k < count; ++k) {
    const Suggestion& one = run.suggestions[k];
    const Edit& edit = one.edit.edit;
    Design after = run.space->edited(run.design, edit, run.constraints).design;
    const std::string number = std::to_string(k + 1), words = describe(edit, names),
                      values = values_text(one.measured, one.energy);
    const DeformationResult result{std::nullopt, after.shape, after.primitives};
    write_deformation_picture(
        {(folder / ("suggestion_" + number + ".png")).string(), title_of(model) + ", suggestion " + number},
        {before, result, {edit}, {}, {words, values + "   " + one.edit.why}});
    sheet.tiles.push_back({std::move(after), edit.handle, {}, {number + ": " + values, words, one.edit.why}});
  }
  write_design_sheet({(folder / "suggestions.png").string(), title_of(model)}, sheet);
}

}  // namespace stackabilization::apps
