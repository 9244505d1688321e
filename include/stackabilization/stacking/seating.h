#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// Options of `seating`.
struct SeatingOptions {
  double friction = 0.3;  ///< coefficient of Coulomb friction between copies, finite, >= 0
  ContactSemantics semantics = ContactSemantics::solid;  ///< semantics of the f_max between copies
  /// Points within this distance of the contact hold the copy, fraction of the extent h, in (0, 1).
  double band = 0.002;
  /// Largest distance across r at which walls of two copies are tight, model units, finite, >= 0. If empty,
  /// tolerance::side_gap of the diagonal.
  std::optional<double> side_gap;
  int samples = 4000;  ///< points of the surface at which tight walls are looked for, >= 1
  /// Direction against gravity, of any length > 0. If empty, r.
  std::optional<Eigen::Vector3d> up;
};

/// Walls of a copy that are so close to walls of the one below that pulled askew they touch.
struct TightWalls {
  int upper_part = -1;       ///< part of the copy below
  int lower_part = -1;       ///< part of the copy above
  double gap = 0;            ///< least distance across r that was found, model units
  double draft_degrees = 0;  ///< least angle to r of the walls that were found
  double area = 0;           ///< of the wall of the copy above, model units squared, to one sample's share
};

/// How a copy sits in the one below.
struct Seating {
  /// Least slope over which a copy that is shifted without tilting slides back, over all sides: it centres
  /// itself where friction is below. 0: it stays where it is put, towards at least one side. Negative: it
  /// slides off its place by itself, over a slope of this size at least.
  double centring_slope = 0;
  double draft_degrees = 90;  ///< least angle between r and the surfaces on which copies touch
  /// Force that pulls a copy off, over that with which it was pressed on, at most; 0: it does not jam. Of a
  /// cone with the draft a: (friction cos a - sin a) / (friction cos a + sin a).
  double pull_off = 0;
  int upper_part = -1;            ///< part of the copy below at the contact that jams; -1: none
  int lower_part = -1;            ///< part of the copy above there; -1: none
  std::vector<TightWalls> tight;  ///< steeper than friction, least draft first
  /// As `pull_off`, of a copy that is pressed against tight walls, too; 0: they hold no more than contacts
  /// do.
  double walls_pull_off = 0;

  /// Returns whether a copy can jam, by its contacts or by tight walls.
  bool jams() const { return pull_off > 0 || walls_pull_off > 0; }
};

/// Computes how a copy of a shape that is stacked along r sits in the one below.
///
/// Contacts are those within the band, with the normals of the surfaces that touch. A shift d across the
/// upward direction lifts the copy over the contact with the normal n by at least -n.d / n.up; the largest of
/// these slopes, over the side with the smallest, is the centring slope. A copy jams when forces within the
/// friction cones, in balance with each other sideways, resist a pull along r through the centre of mass
/// (the condition of a self-locking taper). Of all such forces those count that resist most.
///
/// Contacts in double precision, forces exactly for pyramids of 32 sides inside the friction cones. Tight
/// walls are sampled (surface_samples) and may be missed where they are smaller than a sample's share of the
/// area; of closed parts they look outwards, whatever the orientation of the triangles. Of more than 96 holds
/// those count that are most different from each other. Deterministic. Throws
/// UsageError for options out of range and where r does not point upwards. Throws InputError when
/// `validate(shape)` fails, the shape has no area, or its copies pass each other along r.
Seating seating(const Shape& shape, const Direction& direction, const SeatingOptions& options = {});

}  // namespace stackabilization
