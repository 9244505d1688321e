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

/// Step of `analyse_structure`.
enum class AnalysisStep {
  parts,       ///< cutting the shape into parts
  primitives,  ///< fitting a primitive to each
  symmetries,  ///< finding the symmetries of the whole shape and of its parts
  joints,      ///< finding the joints between parts
};

/// Options of the steps of `analyse_structure`, in the order of the steps.
struct AnalysisOptions {
  SegmentationOptions segmentation;            ///< segmentation into parts
  FitOptions fit;                              ///< fitting of primitives; `kinds` overrides `fit.kind`
  std::map<std::string, PrimitiveKind> kinds;  ///< primitive kind that is forced for a part, by part name
  SymmetryOptions symmetry;                    ///< symmetry detection
  JointOptions joints;                         ///< joint detection
  std::size_t max_parts = 20'000;              ///< limit of the number of parts; more parts are refused
  /// Called from time to time from the calling thread, with the current step and its completed fraction in
  /// [0, 1].
  std::function<void(AnalysisStep, double)> progress = {};
};

/// Computes the structure of a mesh (paper, section 4.1): the parts, a primitive for each part, the
/// symmetries of the whole shape found by voting, the resulting symmetry relations of the parts, and the
/// joints. The primitives of symmetric parts are made exactly symmetric. Deterministic, with the same result
/// for any number of threads.
///
/// The cost grows nearly linearly with the number of parts and with the number of pairs of nearby parts.
/// Throws InputError when `shape` is invalid or a part has no area. Throws InputError before fitting when
/// there are more than AnalysisOptions::max_parts parts or more than JointOptions::max_pairs pairs. Throws
/// UsageError for options out of range and for a forced kind of a part that does not exist.
StructuredShape analyse_structure(const Shape& shape, const AnalysisOptions& options = {});

/// Symmetrizes the primitives: they satisfy all symmetry relations of `structure` exactly, up to rounding.
/// Symmetric parts get primitives of the same kind, computed from the mean of their control points. Throws
/// InputError, naming the relations, when relations contradict each other.
void symmetrize(Structure& structure);

}  // namespace stackabilization
