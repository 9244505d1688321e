#pragma once

/// The only place of this library with small literals. Predicates are exact and use none of them; these bound
/// constructions in double precision and choose defaults of options.
namespace stackabilization::tolerance {

/// Relative accuracy demanded of constructions in double precision (boxes, areas, centres), as a fraction of
/// the bounding-box diagonal. It sits more than six decades above the rounding of coordinates near the
/// origin, and more than two for coordinates 1e4 diagonals away.
inline constexpr double relative = 1e-9;

/// Rounding allowance of constructions in double precision, as a fraction of the largest coordinate: two hull
/// triangles whose corners lie within it of one plane are one face, and points closer than it are one corner
/// of a polygon.
inline constexpr double rounding = 1e-13;

/// Bound, several times over, of the rounding of p . r or of a planar area, as a fraction of the sum of the
/// magnitudes of its products: 16 units in the last place.
inline constexpr double product_rounding = 0x1p-48;

/// Default width of the contact band { f >= f_max - eps }, as a fraction of the extent h along the direction:
/// wide enough that the ring of a cup modelled with facets hangs together, narrow enough that second contacts
/// stay out.
inline constexpr double contact_band = 0.0125;

/// Width at which a certified enclosure of a separation stops tightening, as a fraction of the extent of the
/// shapes along the file axis next to the direction.
inline constexpr double enclosure_width = 1e-12;

/// How far above and below an exact f_max a collision test must be free and colliding, as a fraction of the
/// extent h.
inline constexpr double collision_margin = 1e-9;

/// Error of a sampled f_max, as a fraction of the extent h, from which on a reader deserves an explanation.
inline constexpr double sampling_error = 1e-3;

/// Angular step, in radians, at which a local direction search stops: moving by it changes S by about 1e-8 at
/// most.
inline constexpr double direction_step = 1e-8;

/// Two directions whose S differ by less are equally good: below it lies rounding.
inline constexpr double stackability = 1e-11;

/// Coordinates of a shape lie within these, in any unit, so that volumes, inertia and squares of areas
/// neither overflow nor underflow.
inline constexpr double largest_coordinate = 1e60;
inline constexpr double smallest_shape = 1e-60;  ///< of the largest coordinate, unless all are 0

/// Height, as a fraction of the extent, of the slab whose points `inspect` takes as what a shape stands on.
inline constexpr double support_slab = 1e-2;

/// `inspect` names an up axis only when every other axis fits less than this fraction as well.
inline constexpr double clear_lead = 0.9;

/// How far a relation of a shape's structure may be from holding after an edit, as a fraction of the diagonal.
inline constexpr double relation = 1e-6;

/// Factor of length, area or volume below which a feature curve counts as flattened by an edit.
inline constexpr double flattened_wire = 1e-3;

}  // namespace stackabilization::tolerance
