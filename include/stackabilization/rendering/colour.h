#pragma once

namespace stackabilization {

/// sRGB components in [0, 1].
struct Colour {
  double red = 0, green = 0, blue = 0;  ///< gamma-encoded, in [0, 1]
};

/// The palette of the paper's figures.
namespace palette {
inline constexpr Colour input{0.96, 0.78, 0.28};    ///< a shape as given
inline constexpr Colour output{0.47, 0.71, 0.36};   ///< a shape after improvement
inline constexpr Colour upper{0.27, 0.49, 0.78};    ///< upper envelope
inline constexpr Colour lower{0.95, 0.56, 0.18};    ///< lower envelope, contact parts
inline constexpr Colour contact{0.84, 0.10, 0.12};  ///< contact regions, active handles
inline constexpr Colour ink{0.13, 0.14, 0.16};      ///< text and lines
inline constexpr Colour faint{0.38, 0.40, 0.43};    ///< secondary text and lines
inline constexpr Colour white{1, 1, 1};             ///< ground
}  // namespace palette

/// Returns (1 - t) a + t b, component by component, t in [0, 1].
Colour mix(const Colour& a, const Colour& b, double t);

/// Returns the colour of the perceptually uniform colour map viridis (van der Walt and Smith 2015) at t,
/// clamped to [0, 1]. Low values are dark blue, high values are yellow. It is a fit of degree six within 0.01
/// of the published table.
Colour viridis(double t);

}  // namespace stackabilization
