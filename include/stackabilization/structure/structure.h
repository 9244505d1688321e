#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/structure/primitive.h"
#include "stackabilization/structure/symmetry.h"

namespace stackabilization {

/// How well the two kinds of primitive hold a part: see fitting.h for what the errors measure.
struct PrimitiveFit {
  double cuboid_error = 0;               ///< fraction of the part's bounding-box diagonal
  std::optional<double> cylinder_error;  ///< the same; nothing where no cylinder could be fitted
  std::string note;                      ///< one clause on what was done to the part first; may be empty
};

/// A part of a shape and what stands for it.
struct Part {
  std::string name;     ///< as in Shape::part_names
  Primitive primitive;  ///< model units
  PrimitiveFit fit;     ///< how well either kind holds the part
};

/// Kinds of relations between parts (paper, section 4.1).
enum class RelationType { symmetry, self_symmetry, point_joint, line_joint };

/// What an edit has to keep.
struct Relation {
  RelationType type = RelationType::symmetry;  ///< which of the fields below count
  std::vector<int> parts;  ///< rows of Structure::parts: one for self_symmetry, two different ones otherwise
  Symmetry symmetry;       ///< of symmetry (takes the first part onto the second) and self_symmetry
  Points points;           ///< of joints, where the parts meet at rest: 1 x 3, or the 2 x 3 ends of a line
  double residual = 0;     ///< how far the surfaces miss it at rest, fraction of Structure::diagonal
};

/// Parts, primitives and relations of one shape at rest.
///
/// The primitives satisfy every symmetry relation exactly, up to rounding, also where the mesh does so only
/// nearly: they are the idealised design, and the mesh rides on them with its irregularities.
struct Structure {
  std::vector<Part> parts;           ///< one per part of the shape, in its order
  std::vector<Symmetry> symmetries;  ///< of the whole shape, best first
  std::vector<Relation> relations;   ///< symmetries before joints, then by parts
  double diagonal = 0;               ///< of the bounding box of the shape, model units
};

/// A shape with its structure: what edits start from and what a project file holds.
struct StructuredShape {
  Shape shape;          ///< the mesh at rest
  Structure structure;  ///< one part per part of `shape`
};

/// "symmetry", "self_symmetry", "point_joint", "line_joint".
std::string name_of(RelationType type);

/// Throws InputError, naming the part or relation, unless there is one primitive per part of `shape` under
/// its name and every relation refers to existing parts and has what its type needs.
void validate(const StructuredShape& structured);

}  // namespace stackabilization
