#pragma once

#include <memory>

#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/deformation/wire_analysis.h"

namespace stackabilization {

/// What an IWiresModel takes for wires, and what it keeps between them.
struct IWiresOptions {
  FeatureCurveOptions curves;     ///< what is a wire
  WireAnalysisOptions relations;  ///< what is kept; no symmetry unless given here
  /// Wires of networks that do not join keep their offset, as well as all else allows, where they come as
  /// near as this; fraction of the diagonal of the shape's bounding box.
  double link_distance = 0.03;
};

/// iWires (Gal, Sorkine, Mitra and Cohen-Or 2009): the feature curves of a shape are its wires. An edit of
/// one of them is carried on to all others so that each keeps what it is by itself (straight, circular,
/// planar) and what it is to the others (parallel, in one plane, of equal length, symmetric, joined); the
/// surface follows.
///
/// Handles: HandleKind::shape, which takes any operation as an affine map and carries the symmetries along,
/// and HandleKind::wire with the rows of WireStructure::wires. Wires take moves, rotations and scalings in
/// all directions about Wire::centre, wherever earlier edits have brought it.
///
/// What holds in every result, to rounding where the relations at rest do so, and else to
/// WireAnalysisOptions::distance_tolerance:
///
/// * the edited wire is where the edit puts it;
/// * straight, circular and planar wires stay straight, circular and planar;
/// * parallel wires stay parallel. Moves and scalings keep all directions; a rotation turns what is parallel
///   to the wire and leaves the rest, so it may give up right angles and planes: a box becomes a
///   parallelepiped. Where that cannot be, everything turns;
/// * parallel segments of equal length stay so in moves and scalings, and circles of equal radius unless one
///   of them is scaled;
/// * mirror images stay images, always to 1e-6 of the diagonal, measured on the vertices;
/// * vertices of equal coordinates stay together.
///
/// Refused, with the wire and by how much, is an edit against which symmetries, junctions or fixed points
/// stand, one that flattens a wire or turns it inside out, and what DeformationConstraints forbid. Where the
/// extent is to be kept, the wires that define it are held; where that cannot be, the result is stretched
/// back along the direction (vertex_constraints.h), wires included.
class IWiresModel final : public DeformationModel {
 public:
  /// Throws InputError when the shape is invalid or has no feature curve (smooth closed surfaces), UsageError
  /// for options out of range.
  explicit IWiresModel(Shape rest, const IWiresOptions& options = {});
  IWiresModel(IWiresModel&&) noexcept;
  IWiresModel& operator=(IWiresModel&&) noexcept;
  ~IWiresModel() override;

  /// Wires at rest and what is kept between them.
  const WireStructure& wires() const;

  std::vector<Handle> handles() const override;
  Eigen::Vector3d centre(const Handle& handle) const override;
  DeformationResult deformed(const std::vector<Edit>& edits,
                             const DeformationConstraints& constraints = {}) const override;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// For each row of WireStructure::symmetric, how far the displacements of a wire and of its image are from
/// being images of each other: largest distance over the vertices of the image, model units. `vertices`: n x
/// 3, those of `rest` deformed. Recomputed from the vertices alone: the independent check of the model.
std::vector<double> wire_symmetry_residuals(const Shape& rest, const WireStructure& structure,
                                            const Points& vertices);

}  // namespace stackabilization
