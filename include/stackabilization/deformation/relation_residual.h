#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Computes the residual of each relation of `rest` between deformed primitives, fraction of
/// Structure::diagonal; one number per row of Structure::relations:
///
/// * symmetry, self_symmetry: the largest distance between the image of a control point and its counterpart,
///   or the largest difference of radii if that is greater;
/// * joints: the largest distance between the positions to which the two primitives carry a joint point
///   (transfer.h), beyond the slack of the joint; of a joint that may slide, only the part of the distance in
///   the directions in which it is held, and how far it has slid beyond the rim or the end of its carrier.
///
/// The function uses the primitives alone and so checks the residuals of a solver independently.
/// Precondition: one primitive per part, of the same kinds and sizes as in `rest`. Throws InputError when
/// symmetric primitives of `rest` differ in kind or in their number of cross-sections.
std::vector<double> relation_residuals(const Structure& rest, const std::vector<Primitive>& deformed);

/// Computes the residual of each relation of `rest` on a deformed mesh, for models whose edits do not move
/// primitives; fraction of Structure::diagonal, one number per row of Structure::relations:
///
/// * symmetry, self_symmetry: the largest distance between the image of a vertex of one part and the point of
///   the other part that was nearest to that image at rest;
/// * joints: the distance between the two points at which the surfaces of the parts met next to a joint point
///   at rest, or came nearest to each other.
///
/// Two places that are apart at rest may be twice as far apart: gaps and irregularities of the mesh stretch
/// with their parts. Only what is beyond that counts.
///
/// The function uses the vertices alone. Precondition: `deformed` has the triangles of `rest`. Throws
/// InputError when a part of a relation has no triangle of positive area.
std::vector<double> mesh_relation_residuals(const StructuredShape& rest, const Shape& deformed);

}  // namespace stackabilization
