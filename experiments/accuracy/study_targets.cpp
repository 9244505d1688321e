#include "accuracy/study_targets.h"

#include <algorithm>
#include <map>
#include <set>

#include "accuracy/sampling.h"
#include "common/authors_targets.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/stackability.h"
#ifdef STACKABILIZATION_WITH_RENDERING
#include "stackabilization/core/number_text.h"
#include "stackabilization/rendering/depth_raster.h"
#endif

namespace stackabilization::experiments {
namespace {

namespace fs = std::filesystem;

/// S along z in the boxes of the frame with this translation, model units.
double stackability_in_frame(const Shape& shape, double translation) {
  StackabilityOptions options;
  options.boxes = BoxModel::frame;
  return stackability(shape, Direction(0, 0, 1), options).value_at(translation);
}

/// The targets in (exact, read], each once, ascending.
std::string misread(const std::map<std::string, AuthorsTarget>& targets, double exact, double read) {
  std::set<std::string> texts;
  for (const auto& [name, task] : targets)
    if (task.target > exact && task.target <= read) texts.insert(shortest_text(task.target));
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : " ") + text;
  return list;
}

struct Reading {
  double across, translation;
};

#ifdef STACKABILIZATION_WITH_RENDERING
std::optional<Reading> authors_reading(const Shape& shape) {
  const Direction up(0, 0, 1);
  const Window window = authors_window(shape, up);
  const double side = std::max(range_along(shape, Eigen::Vector3d::UnitX()).length(),
                               range_along(shape, Eigen::Vector3d::UnitY()).length());
  return Reading{side / window.pixel_size,
                 maximum_gap(height_field_by_depth_buffer(shape, up, window)).value};
}
#else
std::optional<Reading> authors_reading(const Shape&) {
  return std::nullopt;
}
#endif

}  // namespace

void compare_study_targets(const fs::path& paper_data, Report& report) {
  const auto target_of = authors_targets(paper_data);
  Table& table = report.table("study", {{"model", ColumnKind::key},
                                        {"input_hash", ColumnKind::key},
                                        {"pixels_across"},
                                        {"S_exact"},
                                        {"S_as_they_read_it"},
                                        {"S_error"},
                                        {"own_target"},
                                        {"targets_that_look_met_and_are_not"}});
  const auto measure = [&](const ModelFile& model, const Shape& shape, const std::string& hash) {
    const auto reading = authors_reading(shape);
    if (!reading) return;
    const double exact =
        stackability_in_frame(shape, minimal_stacking_translation(shape, Direction(0, 0, 1)).length);
    const double read = stackability_in_frame(shape, reading->translation);
    const bool of_study = model.name.find("UserStudyApp") != std::string::npos;
    const auto own = target_of.find(plain_task_name(model.path.stem().string()));
    table.add({model.name, hash, reading->across, exact, read, read - exact,
               of_study && own != target_of.end() ? Cell(own->second.target) : Cell(),
               misread(target_of, exact, read)});
  };
  for_each_model(paper_models(paper_data), report, measure);
}

}  // namespace stackabilization::experiments
