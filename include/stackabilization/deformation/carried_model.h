#pragma once

#include <memory>
#include <vector>

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization {

/// Returns a shape with an empty structure, for models that need none: no parts, no symmetries, no relations.
/// Such a shape is not valid in the sense of `validate(StructuredShape)`. Throws InputError when the shape is
/// invalid.
StructuredShape unstructured(Shape shape);

/// Base of the models that move the vertices of a mesh. Every design is made from rest, with all of its
/// edits. The mesh carries the primitives of the structure along, so that energies are defined for every
/// model: each primitive follows the affine map that fits the displacements of its part best in the
/// least-squares sense, or only the mean translation where the vertices of the part do not determine an
/// affine map.
///
/// Refuses what `moved` refuses, and edits after which a triangle has lost a side: compared with its other
/// sides, that side is shorter than tolerance::collapse of what it was at rest.
class CarriedModel : public DeformationModel {
 public:
  const StructuredShape& rest() const final;
  DeformationResult edited(const Design& now, const Edit& edit,
                           const DeformationConstraints& constraints = {}) const final;

 protected:
  /// Precondition: the structure of `rest` is valid or empty.
  explicit CarriedModel(StructuredShape rest);

 private:
  /// Returns the vertices after all edits, made to the shape at rest one after the other. Throws as `edited`.
  virtual MovedVertices moved(const std::vector<Edit>& edits,
                              const DeformationConstraints& constraints) const = 0;

  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace stackabilization
