#pragma once

/// Tolerances of separations and contact regions.
namespace stackabilization::tolerance {

/// Default width of the contact band { f >= f_max - eps }, fraction of the extent h along the direction. It
/// is wide enough to connect the ring of a cup modelled with facets, and narrow enough to exclude second
/// contacts.
inline constexpr double contact_band = 0.0125;

/// Width at which the enclosure of a separation is not refined further, fraction of the extent of the shapes
/// along the file axis next to the direction.
inline constexpr double enclosure_width = 1e-12;

/// Two planes between touching triangles are one plane when their normals differ by less, fraction of the
/// length of the normals.
inline constexpr double same_normal = 1e-7;

}  // namespace stackabilization::tolerance
