#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "stackabilization/structure/fitting.h"
#include "stackabilization/structure/joints.h"
#include "stackabilization/structure/segmentation.h"
#include "stackabilization/structure/structure.h"
#include "stackabilization/structure/symmetry_detection.h"

namespace stackabilization {

/// What `analyse_structure` is doing.
enum class AnalysisStep {
  parts,       ///< cutting the shape into parts
  primitives,  ///< fitting a primitive to each
  symmetries,  ///< of the whole, and of parts
  joints,      ///< where parts meet
};

/// Options of the steps of `analyse_structure`, in their order.
struct AnalysisOptions {
  SegmentationOptions segmentation;            ///< how parts are found
  FitOptions fit;                              ///< of the parts that are not in `kinds`
  std::map<std::string, PrimitiveKind> kinds;  ///< forced per part, by name
  SymmetryOptions symmetry;                    ///< which symmetries count
  JointOptions joints;                         ///< where parts meet
  std::size_t max_parts = 20'000;              ///< more parts are refused
  /// Called now and then from the calling thread, with the step and what is done of it, in [0, 1].
  std::function<void(AnalysisStep, double)> progress = {};
};

/// From a mesh to its structure (paper, section 4.1): parts, a primitive for each, global symmetries by
/// voting and what they mean for the parts, joints. The primitives of symmetric parts are made exactly
/// symmetric. Deterministic, the same for any number of threads.
///
/// The work grows near linearly with the parts and with the pairs of them that come near each other. Throws
/// InputError when there are more of either than AnalysisOptions::max_parts and JointOptions::max_pairs,
/// before anything is fitted; when `shape` is invalid or a part has no area; UsageError for options out of
/// range or a forced kind for a part that does not exist.
StructuredShape analyse_structure(const Shape& shape, const AnalysisOptions& options = {});

/// Makes the primitives satisfy all symmetry relations of `structure` exactly, up to rounding: symmetric
/// parts get the same kind of primitive and the mean of their control points. Throws InputError when
/// relations contradict each other, naming them.
void symmetrize(Structure& structure);

}  // namespace stackabilization
