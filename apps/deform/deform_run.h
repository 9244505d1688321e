#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/json.h"
#include "apps/common/structured_model.h"
#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/improvement/explanation.h"

namespace stackabilization::apps {

/// Options of `stackabilize deform` as typed.
struct DeformCommandOptions {
  CommonOptions common;
  AnalysisArguments analysis;
  DeformationKind kind = DeformationKind::controllers;
  std::optional<Following> following;        ///< of controllers; default free
  std::optional<Eigen::Vector3d> direction;  ///< of gap scaling; default 0 0 1
  std::vector<std::string> edits;
  std::vector<std::string> fixed_parts;
  std::vector<Eigen::Vector3d> fixed_points;
  std::optional<Eigen::Vector3d> keep_extent;
  std::optional<ExtentEnds> extent_ends;  ///< default: free
  std::optional<double> box_tolerance;
  std::optional<std::string> output, picture, save;
  bool list_handles = false;
};

/// Edits of one shape at rest, and what became of it.
struct DeformRun {
  DeformationKind kind = DeformationKind::controllers;
  Following following = Following::free;
  StructuredShape rest;
  std::vector<Edit> edits;
  DeformationConstraints constraints;
  DeformationResult result;
  std::vector<std::vector<std::int32_t>> curves;  ///< vertices along the feature curves that were edited
  Explanation explanation;                        ///< what a person sees of it; empty for a refusal
  std::vector<double> residuals;                  ///< of the relations, recomputed from the result
};

/// The model that `options` ask for, for a shape at rest. Throws as its constructor does.
std::unique_ptr<DeformationModel> model_for_edits(const DeformCommandOptions& options, StructuredShape rest);

DeformRun run_deform(const DeformCommandOptions& options, const StructuredModel& input);

/// How far the vertices that triangles use went, model units.
struct Displacement {
  double root_mean_square = 0, largest = 0;
};
Displacement displacement(const Shape& before, const Shape& after);

/// {edits, deformation, refusal, residuals, relations, extent, ...}
void add_deformation(Json& document, const DeformRun& run);
std::string deformation_text(const DeformRun& run, const Model& model);
/// Lines for a picture.
std::vector<std::string> deformation_notes(const DeformRun& run);

/// Handles of a model with their centres, as JSON and as a table.
Json handles_json(const DeformationModel& model, const Shape& shape);
std::string handles_text(const DeformationModel& model, const Shape& shape);

}  // namespace stackabilization::apps
