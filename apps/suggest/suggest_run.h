#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/json.h"
#include "apps/common/requirement_options.h"
#include "apps/common/structured_model.h"
#include "stackabilization/improvement/suggestions.h"

namespace stackabilization::apps {

/// Options of `stackabilize suggest` as typed.
struct SuggestCommandOptions {
  CommonOptions common;
  AnalysisArguments analysis;
  StackabilityOptions measure;
  std::optional<DeformationKind> kind;
  std::optional<Eigen::Vector3d> direction;
  EditFamily family = EditFamily::extended;
  bool bends = false;
  std::optional<double> alpha, target;
  RequirementArguments requirements;
  int top = 12;      ///< suggestions that are shown
  bool all = false;  ///< the refused ones too, with their reasons
  std::optional<int> apply, roll_back;
  bool show_history = false;
  std::optional<std::string> save, pictures;

  /// Where the project goes; nothing when it is not written.
  std::optional<std::string> destination() const;
};

/// One step of an editing session.
struct SuggestRun {
  Project project;  ///< as it is to be written: with the node that was applied
  Direction direction{0, 0, 1};
  std::unique_ptr<DeformationModel> space;
  DeformationConstraints constraints;
  Design design;                        ///< the current one, before anything is applied
  int node = 0;                         ///< its row in the history
  double alpha = 0;                     ///< of the energies
  Situation now;                        ///< of it
  std::vector<Suggestion> suggestions;  ///< empty when none were asked for
  std::optional<int> applied;           ///< row of `suggestions`
  /// How many of the suggestions can be made: they come first.
  std::size_t possible() const;
};

/// Throws UsageError for options that do not fit the model.
SuggestRun run_suggest(const SuggestCommandOptions& options, const StructuredModel& input);

void add_suggestions(Json& document, const SuggestRun& run, const SuggestCommandOptions& options);
std::string suggestions_text(const SuggestRun& run, const SuggestCommandOptions& options, const Model& model);
/// The tree, a node per line.
std::string history_text(const Project& project);
/// Per possible suggestion that is shown: its number, S and E.
std::string essential_suggestions(const SuggestRun& run, const SuggestCommandOptions& options);

/// The folder of --pictures.
OwnedFolder suggestion_folder(const std::string& path);

/// Makes the folder where it is missing and writes suggestions.png, all that are shown on one sheet, and
/// suggestion_K.png, the shape before and after each of them. Throws OutputError.
void write_suggestion_pictures(const SuggestRun& run, const SuggestCommandOptions& options,
                               const Model& model);

}  // namespace stackabilization::apps
