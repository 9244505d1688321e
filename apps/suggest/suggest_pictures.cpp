#include <algorithm>
#include <cctype>
#include <filesystem>

#include "apps/common/rendering.h"
#include "apps/common/text.h"
#include "apps/suggest/suggest_run.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::apps {

namespace {

constexpr const char* sheet_name = "suggestions.png";

std::string picture_name(std::size_t number) {
  return "suggestion_" + std::to_string(number) + ".png";
}

/// Is it a name that this command gives to files?
bool is_picture(const std::string& name) {
  const std::string start = "suggestion_", ending = ".png";
  return name == sheet_name ||
         (name.size() > start.size() + ending.size() && name.starts_with(start) && name.ends_with(ending) &&
          std::all_of(name.begin() + static_cast<std::ptrdiff_t>(start.size()),
                      name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                      [](unsigned char c) { return std::isdigit(c) != 0; }));
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

OwnedFolder suggestion_folder(const std::string& path) {
  return {path, is_picture};
}

void write_suggestion_pictures(const SuggestRun& run, const SuggestCommandOptions& options,
                               const Model& model) {
  const std::size_t count = std::min(run.possible(), static_cast<std::size_t>(options.top));
  std::vector<std::string> files = {sheet_name};
  for (std::size_t k = 0; k < count; ++k) files.push_back(picture_name(k + 1));
  OwnedFolder folder = suggestion_folder(*options.pictures);
  folder.begin(files);
  const std::vector<std::string>& names = run.project.rest.shape.part_names;
  const StructuredShape before = as_rest(run.project.rest, run.design);
  DesignSheet sheet;
  sheet.direction = run.direction;
  sheet.notes = {direction_text(run.direction.vector()) + ", with contact regions in red"};
  sheet.tiles.push_back({run.design,
                         std::nullopt,
                         run.now.contacts,
                         {"now: " + values_text(run.now.measured, run.now.energy)}});
  for (std::size_t k = 0; k < count; ++k) {
    const Suggestion& one = run.suggestions[k];
    const Edit& edit = one.edit.edit;
    Design after = run.space->edited(run.design, edit, run.constraints).design;
    const std::string number = std::to_string(k + 1), words = describe(edit, names),
                      why = describe(one.edit.reason, names), values = values_text(one.measured, one.energy);
    write_deformation_picture(
        {(folder.path() / files[k + 1]).string(), title_of(model) + ", suggestion " + number},
        {before, after, {edit}, {}, {words, values + "   " + why}});
    sheet.tiles.push_back({std::move(after), edit.handle, {}, {number + ": " + values, words, why}});
  }
  write_design_sheet({(folder.path() / sheet_name).string(), title_of(model)}, sheet);
  folder.remove_others(files);
  folder.finish(files);
}

}  // namespace stackabilization::apps
