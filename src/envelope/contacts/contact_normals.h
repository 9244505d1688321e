#pragma once

#include <Eigen/Core>
#include <optional>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/contacts.h"

namespace stackabilization::detail {

/// Normals of the surfaces on which copies touch along r. Which triangle's normal a contact polygon has:
///
/// | contact | normal |
/// | --- | --- |
/// | face on face | that of the face with the smaller angle to r |
/// | edge or corner on face | that of the face |
/// | edge or corner on edge or corner | that of the face with the larger angle to r |
///
/// So legs with steep walls on a level top have the normal of the top, and a peg with upright walls in a
/// conical hole that of the hole. Double precision; points within tolerance::relative of the diagonal of an
/// edge count as on the edge.
class ContactNormals {
 public:
  /// `shape` must outlive this object.
  ContactNormals(const Shape& shape, const Direction& direction);

  /// Returns the unit normal at a contact polygon of the shape, towards the copy above: normal . r >= 0,
  /// whatever the orientation of the triangles. Nothing if a triangle has no area.
  std::optional<Eigen::Vector3d> normal(const ContactPolygon& polygon) const;

 private:
  struct Touched;
  std::optional<Touched> touched(Eigen::Index triangle, const Eigen::Vector3d& point) const;

  const Shape& shape_;
  Eigen::Vector3d up_;
  double reach_;
};

}  // namespace stackabilization::detail
