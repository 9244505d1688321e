#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/deformation/design.h"
#include "stackabilization/deformation/edit.h"
#include "stackabilization/deformation/refusal.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Deformation models.
enum class DeformationKind { controllers, surface, iwires, gap_scaling };

/// Returns all kinds, in their order.
const std::vector<DeformationKind>& deformation_kinds();

/// Returns "controllers", "surface", "iwires" or "gap-scaling".
std::string name_of(DeformationKind kind);

/// How the parts that are not edited follow an edit, with controllers.
enum class Following {
  /// Any way, cheap motions first: parts move, stretch and lean, generalized cylinders bend, single corners
  /// of cuboids move.
  free,
  /// Only by affine maps; straight generalized cylinders lean, stretch and change their radii linearly.
  /// Joints slide in the planes of plates and along straight members (Relation::carrier), with a little slack
  /// (Relation::slack). Rows of parts stay even (part_rows.h, ControllerLimits). A part that moves as a
  /// whole keeps its heights along the move; if changes of it and its rows across the move close its joints,
  /// no other part follows. Edits that need more are refused.
  smooth,
};

/// What users of a deformation model have to know of it beside its handles. Known before a model is prepared.
struct DeformationCapabilities {
  /// Whether edits change primitives, and the mesh follows. The handles then are the shape, parts, faces,
  /// corners and cross-sections, the primitives determine the design, and relations between parts hold
  /// between primitives. Otherwise edits change the mesh, which carries the primitives along.
  bool edits_primitives = false;
  /// Whether an edit of a part is made to the parts symmetric to it as well.
  bool edits_symmetric_parts = false;
  /// Whether all edits are along one direction, DeformationModelOptions::direction.
  bool edits_along_one_direction = false;
};

/// Returns what the models of a kind are able to do.
const DeformationCapabilities& capabilities_of(DeformationKind kind);

/// A design after edits, or the reason why one of them was refused.
struct DeformationResult {
  std::optional<Refusal> refusal;  ///< reason; when set, `design` is the design before the refused edit
  Design design;                   ///< the design with the edits, unless one was refused
};

/// Vertices after edits, or the reason why they were refused.
struct MovedVertices {
  std::optional<Refusal> refusal;  ///< reason
  Points vertices;                 ///< n x 3 vertices, model units; of no use after a refusal
};

/// Interface of the deformation models: the designs that a model can make of one structured shape. A model is
/// prepared once for a shape at rest (factory.h) and then applies any number of edits. Queries are const,
/// deterministic and safe from any number of threads.
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

  /// Returns which deformation model this is, for files and reports.
  virtual DeformationKind kind() const = 0;
  /// Returns how parts follow an edit; free for models other than controllers.
  virtual Following following() const { return Following::free; }
  /// Returns what the model is able to do.
  const DeformationCapabilities& capabilities() const { return capabilities_of(kind()); }

  /// Returns the shape without edits, with its structure.
  virtual const StructuredShape& rest() const = 0;
  /// Returns the design without edits: vertices and primitives are those at rest, to the bit.
  Design at_rest() const;

  /// Returns all handles that this model can edit.
  virtual std::vector<Handle> handles() const = 0;
  /// Returns the point about which `handle` rotates and scales at rest, model units. Throws UsageError when
  /// the model has no such handle.
  virtual Eigen::Vector3d centre(const Handle& handle) const = 0;
  /// Returns the centres of `handles`, in the same order. Computes them with every call.
  std::vector<Eigen::Vector3d> centres() const;
  /// Returns the vertices along the curve that a handle is, in order, the first again at the end of a closed
  /// curve; rows of the mesh. Empty for handles that are no curves.
  virtual std::vector<std::int32_t> curve(const Handle& handle) const;

  /// Makes one more edit to `now`, a design of this model. The extent and the box that the constraints keep
  /// are those of the shape at rest. Throws UsageError for a handle that this model does not have, for an
  /// operation that the handle does not accept, and under the conditions of `validate` for edits and
  /// constraints.
  virtual DeformationResult edited(const Design& now, const Edit& edit,
                                   const DeformationConstraints& constraints = {}) const = 0;
  /// Makes all edits from rest. The result equals that of one call of `edited` per edit, to the bit. When an
  /// edit is refused, `design` has the edits before it.
  virtual DeformationResult deformed(const std::vector<Edit>& edits,
                                     const DeformationConstraints& constraints = {}) const;

  /// Computes the residual of each relation of the structure in a design of this model, fraction of
  /// Structure::diagonal; one number per row of Structure::relations. Models that edit primitives measure
  /// between the primitives, all others on the mesh (relation_residual.h).
  std::vector<double> relation_residuals(const Design& design) const;
};

}  // namespace stackabilization
