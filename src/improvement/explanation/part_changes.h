#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "improvement/quality/part_form.h"
#include "stackabilization/improvement/explanation.h"

namespace stackabilization::detail {

/// What the changes of parts are relative to.
struct ObjectFrame {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();     ///< unit, against gravity
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< a point of the upright axis of the object
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();   ///< displacement of the whole, which does not count
  double ground = 0, height = 0, diagonal = 0;       ///< at rest, model units; the ground along `up`

  /// Returns the level component of a vector.
  Eigen::Vector3d level(const Eigen::Vector3d& v) const { return v - v.dot(up) * up; }
  /// Returns the displacement that a person sees, model units.
  double visible() const;
};

/// A change with the amount from which on it is named.
struct SeenChange {
  FormChange change;
  double least = 0;

  /// Returns how well a person sees the change, as a multiple of what is named.
  double seen() const { return std::abs(change.amount) / least; }
};

/// A part at rest: its form, and its box along its main axes.
struct PartAtRest {
  PartForm form;
  std::vector<std::int32_t> triangles;
  Eigen::Vector3d low = Eigen::Vector3d::Zero();   ///< lower ends of the box along the axes of the fit
  Eigen::Vector3d high = Eigen::Vector3d::Zero();  ///< upper ends
  double area = 0;                                 ///< model units squared
};

/// Prepares a part.
PartAtRest part_at_rest(const StructuredShape& rest, std::size_t part, std::vector<std::int32_t> triangles);

/// What happened to a part.
struct PartChanges {
  std::vector<SeenChange> changes;  ///< in the order of FormChangeKind
  AffineMap map;                    ///< of the part, less the displacement of the whole
  double displacement = 0;          ///< largest displacement of a corner, model units

  /// Returns how well a person sees the change that is seen best; 0 without changes.
  double max_seen() const;
};

/// Measures the change of a part with a fit.
PartChanges part_changes(const PartAtRest& part, const Shape& rest, const Shape& now,
                         const ObjectFrame& frame);

/// Leaves out what a person hardly sees beside another change of the object, but for the change of each part
/// that is seen best.
void leave_out_minor(std::vector<PartChanges>& parts);

/// Returns what a person calls a part by its form: "upright", "bar", "slat", "panel", "board",
/// "frame" or "part".
std::string form_noun(const PartAtRest& part, const ObjectFrame& frame);

}  // namespace stackabilization::detail
