#pragma once

#include <string>
#include <vector>

#include "common/experiment.h"
#include "deformation_models/trial.h"

namespace stackabilization::experiments {

/// What was found on one model: every variant with its tasks, the mixed one besides with every alpha.
struct Findings {
  std::string model, hash;
  double stackability_at_rest = 0;
  Shape rest;
  double shown_fraction = 0;  ///< of the task whose designs are shown
  std::vector<Trial> trials;  ///< with the alpha of the comparison
  std::vector<Trial> alphas;  ///< of the paper's preset, with the others
};

/// alpha of the comparison, that of the paper.
inline constexpr double common_alpha = 0.2;

/// "paper", "refined".
std::string preset_name(ImprovementPreset preset);

/// A row per trial, and the designs of one target side by side.
void add_rows(const Findings& findings, Report& report);

/// D and the change over S, by model, and D and the cost of a search over alpha; tables `summary` and `alpha`
/// over all models.
void summarise(const std::vector<Findings>& models, Report& report);

}  // namespace stackabilization::experiments
