#pragma once

#include <memory>

#include "stackabilization/deformation/carried_model.h"
#include "stackabilization/deformation/wire_analysis.h"

namespace stackabilization {

/// Options of IWiresModel: the wires and the relations that it keeps.
struct IWiresOptions {
  FeatureCurveOptions curves;     ///< thresholds for wires
  WireAnalysisOptions relations;  ///< relations to keep; no symmetries unless given here
  /// Distance up to which wires of networks that are not joined are linked, fraction of the diagonal of the
  /// shape's bounding box. Linked wires keep their offset as well as the relations allow.
  double link_distance = 0.03;
};

/// iWires (Gal, Sorkine, Mitra and Cohen-Or 2009): deformation of a shape by its feature curves, the wires.
/// An edit of one wire propagates to all others, such that each wire keeps its own properties (straight,
/// circular, planar) and its relations to other wires (parallel, in one plane, of equal length, symmetric,
/// joined). The surface follows the wires.
///
/// Handles: HandleKind::shape accepts any operation; the operation is an affine map, which also transforms
/// the symmetries. HandleKind::wire has the rows of WireStructure::wires as indices. Wires accept moves,
/// rotations and scalings in all directions about the current position of Wire::centre, that is, after all
/// earlier edits.
///
/// Guarantees for every result, up to rounding when the relations at rest hold up to rounding, and otherwise
/// within WireAnalysisOptions::distance_tolerance:
///
/// * the edited wire is where the edit puts it;
/// * straight, circular and planar wires stay straight, circular and planar;
/// * parallel wires stay parallel. Moves and scalings keep all directions. A rotation turns the wires
///   parallel to the edited wire and leaves the others, so right angles and planes may be lost: a box becomes
///   a parallelepiped. When the relations do not allow this, all wires turn;
/// * under moves and scalings, parallel segments of equal length keep equal lengths, and circles of equal
///   radius keep equal radii unless one of them is scaled;
/// * mirror images stay mirror images, always within 1e-6 of the diagonal, measured on the vertices;
/// * vertices of equal coordinates stay together.
///
/// The model refuses an edit that contradicts symmetries, junctions or fixed points, an edit that flattens a
/// wire or turns it inside out, and an edit that violates DeformationConstraints. The refusal names the wire
/// and the amount. To keep an extent, the model holds the wires that define it. When this is impossible, the
/// model stretches the result back along the direction, including the wires (vertex_constraints.h).
class IWiresModel final : public CarriedModel {
 public:
  /// The structure of `rest` is carried along; it may be that of `unstructured`. Throws InputError when the
  /// shape is invalid or has no feature curve (smooth closed surfaces), and UsageError for options out of
  /// range.
  explicit IWiresModel(StructuredShape rest, const IWiresOptions& options = {});
  IWiresModel(IWiresModel&&) noexcept;
  IWiresModel& operator=(IWiresModel&&) noexcept;
  ~IWiresModel() override;

  /// Returns the wires at rest and the relations between them.
  const WireStructure& wires() const;

  DeformationKind kind() const override { return DeformationKind::iwires; }
  std::vector<Handle> handles() const override;
  Eigen::Vector3d centre(const Handle& handle) const override;
  std::vector<std::int32_t> curve(const Handle& handle) const override;

 private:
  MovedVertices moved(const std::vector<Edit>& edits,
                      const DeformationConstraints& constraints) const override;

  struct Data;
  std::unique_ptr<const Data> data_;
};

/// Computes, for each row of WireStructure::symmetric, how far the displacements of a wire and of its image
/// differ from images of each other: the largest distance over the vertices of the image, model units.
/// `vertices`: n x 3, the deformed vertices of `rest`. The function uses the vertices alone and so checks the
/// model independently.
std::vector<double> wire_symmetry_residuals(const Shape& rest, const WireStructure& structure,
                                            const Points& vertices);

}  // namespace stackabilization
