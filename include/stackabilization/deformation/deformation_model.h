#pragma once

#include <optional>
#include <vector>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/deformation/refusal.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Result of a list of edits: the deformed shape, or the reason for the refusal.
struct DeformationResult {
  std::optional<Refusal> refusal;  ///< set when an edit was refused; the other members are then those at rest
  Shape shape;                     ///< triangles and parts of the shape at rest, with moved vertices
  std::vector<Primitive> primitives;  ///< moved primitives, one per part; empty for models without primitives
};

/// Interface of the deformation methods. A model is prepared once for a shape at rest and then applies any
/// number of edits. Queries are const, deterministic and safe from any number of threads.
///
/// Every model guarantees:
///
/// * without edits, and for edits that change nothing, the vertices equal those at rest within 1e-12 of the
///   diagonal;
/// * every vertex of a result is finite;
/// * all constraints hold, or the model refuses the edit.
class DeformationModel {
 public:
  virtual ~DeformationModel() = default;

  /// Returns all handles that this model can edit.
  virtual std::vector<Handle> handles() const = 0;

  /// Returns the point about which `handle` rotates and scales at rest, model units. Throws UsageError when
  /// the model has no such handle.
  virtual Eigen::Vector3d centre(const Handle& handle) const = 0;

  /// Applies `edits` to the shape at rest, one after the other. Throws UsageError for a handle that this
  /// model does not have, for an operation that the handle does not accept, and under the conditions of
  /// `validate` for edits and constraints.
  virtual DeformationResult deformed(const std::vector<Edit>& edits,
                                     const DeformationConstraints& constraints = {}) const = 0;
};

}  // namespace stackabilization
