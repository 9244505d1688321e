#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/model.h"
#include "apps/common/output.h"
#include "apps/common/values.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/history.h"
#include "stackabilization/structure/analysis.h"

namespace stackabilization::apps {

/// Choices of --model.
Choices<DeformationKind> deformation_choices();

/// How a mesh becomes a structure, as typed.
struct AnalysisArguments {
  AnalysisOptions options;
  std::optional<double> symmetry_tolerance;  ///< --symmetry-tolerance
  std::optional<double> joint_reach;         ///< --joint-reach
  std::optional<std::string> seeds;          ///< --seeds
  std::optional<std::string> controllers;    ///< --ctrl
  std::optional<std::string> relations;      ///< --grp
};

/// --segmentation, --segments, --seeds, --primitive, --sections, --symmetry-tolerance, --joint-reach, --ctrl,
/// --grp.
void add_analysis_options(CLI::App& command, AnalysisArguments& arguments);

/// The files among them, for check_outputs.
std::vector<InputFile> analysis_inputs(const AnalysisArguments& arguments);

/// Bounds of the parts of a mesh and of the pairs of them that come near each other, as AnalysisOptions has
/// them, for commands that edit what they analyse: they say so before the analysis.
struct PartBounds {
  std::size_t max_parts;
  std::size_t max_pairs;
};
inline constexpr PartBounds bounds_of_deform{2000, 20'000},
    bounds_of_designs{DeformationLimits().max_parts, 2000};

/// A model with its structure; `structured.shape` is `model.shape`.
struct StructuredModel {
  Model model;
  StructuredShape structured;
  History history;                ///< of the project file; no nodes where there is none
  DeformationModelOptions space;  ///< what made the designs of the history
};

/// Is it the name of a project file, which ends in .json?
bool is_project(const std::string& path);

/// Reads MODEL: a project file as it is, a mesh by analysing it. Throws InputError, and UsageError when
/// options that belong to a mesh are given with a project file. `bounds`: narrower ones than those of the
/// analysis.
StructuredModel load_structured(const CLI::App& command, const CommonOptions& common,
                                const AnalysisArguments& arguments,
                                const std::optional<PartBounds>& bounds = {});

/// Returns the first option given that says how a mesh is read or analysed; nothing where none is.
std::optional<std::string> given_mesh_option(const CLI::App& command);

/// Rows of parts with these names, ascending, each once. Throws UsageError naming the option and the part.
std::vector<int> parts_named(const std::string& option, const std::vector<std::string>& names,
                             const Shape& shape);

}  // namespace stackabilization::apps
