#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Why an edit was not made.
struct Refusal {
  std::string reason;           ///< one sentence: what would break, and by how much
  std::optional<int> relation;  ///< row of Structure::relations, where one of them would break
  double amount = 0;            ///< by how much, fraction of the bounding-box diagonal of the shape at rest
};

/// A shape after edits, or the reason why not.
struct DeformationResult {
  std::optional<Refusal> refusal;     ///< when set, the rest is as it was before
  Shape shape;                        ///< same triangles and parts as at rest, vertices moved
  std::vector<Primitive> primitives;  ///< of the parts, moved; empty for models without primitives
};

/// One way to deform a shape: prepared once for a shape at rest, asked for many edits. Queries are const,
/// deterministic and safe from any number of threads.
///
/// Every model guarantees: no edits, or edits that change nothing, give the vertices at rest to 1e-12 of the
/// diagonal; every vertex of a result is finite; all constraints hold, or there is a refusal.
class DeformationModel {
 public:
  virtual ~DeformationModel() = default;

  /// Everything that can be edited.
  virtual std::vector<Handle> handles() const = 0;

  /// Point about which a handle at rest is turned and scaled, model units. Throws UsageError when there is no
  /// such handle.
  virtual Eigen::Vector3d centre(const Handle& handle) const = 0;

  /// The shape at rest with `edits` made one after the other. Throws UsageError for a handle that this model
  /// does not have, an operation it cannot take, and as `validate` of edits and constraints does.
  virtual DeformationResult deformed(const std::vector<Edit>& edits,
                                     const DeformationConstraints& constraints = {}) const = 0;
};

}  // namespace stackabilization
