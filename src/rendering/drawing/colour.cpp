#include "stackabilization/rendering/colour.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace stackabilization {

Colour mix(const Colour& a, const Colour& b, double t) {
  return {(1 - t) * a.red + t * b.red, (1 - t) * a.green + t * b.green, (1 - t) * a.blue + t * b.blue};
}

Colour viridis(double t) {
  // Coefficients by Matt Zucker (CC0), from the constant term upwards.
  static const std::array<Eigen::Array3d, 7> coefficients{
      Eigen::Array3d(0.2777273272234177, 0.005407344544966578, 0.3340998053353061),
      Eigen::Array3d(0.1050930431085774, 1.404613529898575, 1.384590162594685),
      Eigen::Array3d(-0.3308618287255563, 0.214847559468213, 0.09509516302823659),
      Eigen::Array3d(-4.634230498983486, -5.799100973351585, -19.33244095627987),
      Eigen::Array3d(6.228269936347081, 14.17993336680509, 56.69055260068105),
      Eigen::Array3d(4.776384997670288, -13.74514537774601, -65.35303263337234),
      Eigen::Array3d(-5.435455855934631, 4.645852612178535, 26.3124352495832)};
  const double x = std::clamp(t, 0.0, 1.0);
  Eigen::Array3d value = coefficients.back();
  for (auto c = coefficients.rbegin() + 1; c != coefficients.rend(); ++c) value = value * x + *c;
  const Eigen::Array3d clamped = value.max(0).min(1);
  return {clamped[0], clamped[1], clamped[2]};
}

}  // namespace stackabilization
