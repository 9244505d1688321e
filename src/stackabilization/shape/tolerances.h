#pragma once

/// The only place of this library with small literals. Predicates are exact and use none of them; these bound
/// constructions in double precision and choose defaults of options.
namespace stackabilization::tolerance {

/// Relative accuracy demanded of constructions in double precision (boxes, areas, centres), as a fraction of the
/// bounding-box diagonal. It sits six decades above rounding for coordinates up to 1e4 diagonals from the origin.
inline constexpr double relative = 1e-9;

/// Default width of the contact band { f >= f_max - eps }, as a fraction of the extent h along the direction.
inline constexpr double contact_band = 1e-3;

/// Angular step, in radians, at which a local direction search stops: moving by it changes S by about 1e-8 at most.
inline constexpr double direction_step = 1e-8;

/// Height, as a fraction of the extent, of the slab whose points `inspect` takes as what a shape stands on.
inline constexpr double support_slab = 1e-2;

/// `inspect` names an up axis only when every other axis fits less than this fraction as well.
inline constexpr double clear_lead = 0.9;

}  // namespace stackabilization::tolerance
