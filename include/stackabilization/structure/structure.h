#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/structure/primitive.h"
#include "stackabilization/structure/symmetry.h"

namespace stackabilization {

/// Fit errors of the two kinds of primitive for a part. fitting.h defines the errors.
struct PrimitiveFit {
  double cuboid_error = 0;               ///< fraction of the diagonal of the oriented box of the part
  std::optional<double> cylinder_error;  ///< the same for the cylinder; empty when none could be fitted
  std::string note;                      ///< one clause about the preparation of the part; may be empty
};

/// A part of a shape and its primitive.
struct Part {
  std::string name;     ///< name in Shape::part_names
  Primitive primitive;  ///< model units
  PrimitiveFit fit;     ///< fit errors of both kinds
};

/// Type of a relation between parts (paper, section 4.1).
enum class RelationType { symmetry, self_symmetry, point_joint, line_joint };

/// A relation between parts that every edit must preserve.
struct Relation {
  /// Type; it determines which of the following members are used
  RelationType type = RelationType::symmetry;
  /// Rows of Structure::parts: one row for self_symmetry, two different rows otherwise.
  std::vector<int> parts;
  /// Symmetry of a symmetry relation (it maps the first part to the second) or of a self_symmetry.
  Symmetry symmetry;
  /// Points of a joint at rest: 1 x 3 for a point joint, the 2 x 3 ends for a line joint.
  Points points;
  /// Distance by which the surfaces at rest violate the relation, fraction of Structure::diagonal.
  double residual = 0;
  /// Part on which points of a joint may slide: in the plane of a plate or of a wall of a hollow box, along a
  /// straight member, or up and down the wall of a vessel. -1: they are fixed to both parts. The analysis
  /// makes fixed joints; Following::smooth lets them slide.
  int carrier = -1;
  /// Per row of `points`, along which axes of a carrier that is a cuboid the point slides: not towards a rim
  /// or an end that is near. All or none on other carriers. Empty without a carrier.
  std::vector<std::array<bool, 3>> sliding = {};
  /// How far apart the places of a joint point on its two parts may be, model units. The analysis gives
  /// joints no slack; Following::smooth does, since parts meet in an area and can turn on each other a
  /// little.
  double slack = 0;

  /// Returns whether it is a point joint or a line joint.
  bool is_joint() const { return type == RelationType::point_joint || type == RelationType::line_joint; }
  /// Returns whether row `point` of `points` slides on the carrier.
  bool slides(Eigen::Index point) const {
    return !sliding.empty() && sliding[static_cast<std::size_t>(point)] != std::array<bool, 3>{};
  }
};

/// Parts, primitives and relations of one shape at rest.
///
/// The primitives satisfy every symmetry relation exactly, up to rounding, also where the mesh is only nearly
/// symmetric. The mesh keeps its irregularities relative to its primitives.
struct Structure {
  std::vector<Part> parts;           ///< one per part of the shape, in the order of the shape
  std::vector<Symmetry> symmetries;  ///< symmetries of the whole shape, best first
  std::vector<Relation> relations;   ///< symmetries before joints, then by parts
  double diagonal = 0;               ///< diagonal of the bounding box of the shape, model units
};

/// A shape with its structure: the input of edits and the content of a project file.
struct StructuredShape {
  Shape shape;          ///< the mesh at rest
  Structure structure;  ///< structure with one part per part of `shape`
};

/// Returns "symmetry", "self_symmetry", "point_joint" or "line_joint".
std::string name_of(RelationType type);

/// Returns a relation as words: "point joint of 'leg' and 'top'", "self-symmetry of 'top'". Throws
/// std::out_of_range for a part that the structure lacks.
std::string describe(const Relation& relation, const Structure& structure);

/// Throws InputError, naming the part or the relation, unless the structure matches the shape: every part of
/// `shape` has one primitive under its name, and every relation refers to existing parts and has the members
/// of its type.
void validate(const StructuredShape& structured);

}  // namespace stackabilization
