#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/improve.h"
#include "stackabilization/improvement/shape_change.h"
#include "stackabilization/structure/fitting.h"

namespace stackabilization::experiments {

/// A deformation model as it is compared.
struct Variant {
  std::string name;                                     ///< as tables call it
  DeformationKind kind = DeformationKind::controllers;  ///< what moves the mesh
  std::optional<PrimitiveKind> primitives = {};         ///< forced on every part; nothing: the better fit
  bool keep_height = true;                              ///< of every design, along the direction
};

/// Controllers with cuboids, with cylinders, and mixed; surface; iWires; gap scaling, twice: while the height
/// stays, and with the height let go.
const std::vector<Variant>& variants();
/// The one whose primitives the analysis chooses: every mesh is measured on its structure.
const Variant& mixed_variant();

/// Where every run ends.
struct Limits {
  std::int64_t expansions = 10;  ///< of each search
  int evaluations = 60;          ///< of each refinement
  double seconds = 3600;         ///< what these end depends on the machine
};

/// What is asked of a variant.
struct Task {
  ImprovementPreset preset = ImprovementPreset::refined;
  double alpha = 0.2;     ///< of Eq. 5
  double fraction = 0.5;  ///< of the way from S at rest to 1
  double target = 0;      ///< S there
};

/// A design, measured in the same way whatever made it.
struct Measures {
  double stackability = 0;
  Distortion distortion;      ///< the primitives of the mixed structure carried along with the mesh
  double own_distortion = 0;  ///< D that the search saw, on the primitives of the variant
  ShapeChange change;
  std::int64_t edits = 0;
};

/// What became of a task.
struct Trial {
  std::string variant;
  Task task;
  bool reached = false;
  std::optional<Measures> best;  ///< the best solution, or what came nearest to one
  Shape shape;                   ///< of that
  std::int64_t evaluated = 0;    ///< designs that the search measured
  std::string reason;            ///< why the target was not reached
  double seconds = 0, processor_seconds = 0;
};

/// A model that is stacked along z, in boxes of its file, and measured on one structure, the mixed one.
class Subject {
 public:
  /// Throws InputError where it has no structure or no volume.
  explicit Subject(const Shape& shape);

  const Shape& shape() const { return rest_.shape; }
  double stackability_at_rest() const { return at_rest_; }
  /// Whether the analysis chooses this kind for every part, so that forcing it changes nothing.
  bool consists_of(PrimitiveKind kind) const;

  /// Every task in turn. Where the model cannot be deformed in this way at all, that is the reason of all.
  std::vector<Trial> trials(const Variant& variant, const std::vector<Task>& tasks,
                            const Limits& limits) const;

 private:
  Trial trial(const RequirementChecker& checker, const Task& task, const Limits& limits) const;
  Measures measured(const Candidate& candidate) const;

  StructuredShape rest_;
  EnergyMeter meter_;
  double at_rest_;
};

}  // namespace stackabilization::experiments
