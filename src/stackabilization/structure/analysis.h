#pragma once

#include <map>
#include <string>

#include "stackabilization/structure/fitting.h"
#include "stackabilization/structure/joints.h"
#include "stackabilization/structure/segmentation.h"
#include "stackabilization/structure/structure.h"
#include "stackabilization/structure/symmetry_detection.h"

namespace stackabilization {

/// Options of the steps of `analyse_structure`, in their order.
struct AnalysisOptions {
  SegmentationOptions segmentation;            ///< how parts are found
  FitOptions fit;                              ///< of the parts that are not in `kinds`
  std::map<std::string, PrimitiveKind> kinds;  ///< forced per part, by name
  SymmetryOptions symmetry;                    ///< which symmetries count
  JointOptions joints;                         ///< where parts meet
};

/// From a mesh to its structure (paper, section 4.1): parts, a primitive for each, global symmetries by
/// voting and what they mean for the parts, joints. The primitives of symmetric parts are made exactly
/// symmetric. Deterministic, the same for any number of threads. Throws InputError when `shape` is invalid or
/// a part has no area, UsageError for options out of range or a forced kind for a part that does not exist.
StructuredShape analyse_structure(const Shape& shape, const AnalysisOptions& options = {});

/// Makes the primitives satisfy all symmetry relations of `structure` exactly, up to rounding: symmetric
/// parts get the same kind of primitive and the mean of their control points. Throws InputError when
/// relations contradict each other, naming them.
void idealise(Structure& structure);

}  // namespace stackabilization
