#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "stackabilization/core/shape.h"

/// Random shapes, the same on every machine for one seed, and shapes made from a given one, most of them the
/// same set of points: what invariance tests need.
namespace stackabilization::solids {

/// SplitMix64: tiny, and unlike the distributions of <random> the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  double uniform();  ///< In [0, 1), a multiple of 2^-53.
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  std::uint64_t below(std::uint64_t bound);  ///< In [0, bound).
  Eigen::Vector3d in_cube();                 ///< In [-1, 1)^3.
  Eigen::Vector3d on_sphere();               ///< Uniform on the unit sphere.

 private:
  std::uint64_t state_;
};

/// `count` triangles whose centres lie in [-1, 1]^3 and whose corners lie at most `size` from them along each
/// axis.
struct Soup {
  std::uint64_t seed = 1;
  int count = 100;
  double size = 0.3;
  int parts = 1;  ///< Triangles are dealt to this many parts in turn.
  int grid_bits =
      0;  ///< When positive, corners are rounded to multiples of 2^-grid_bits: many ties and degeneracies.
};
Shape triangle_soup(const Soup& options);

/// Every triangle cut in four at its edge midpoints; neighbours share the new corners, so closed stays
/// closed. The midpoints are exact when the sum of two coordinates is.
Shape subdivided(const Shape& shape);
/// The triangles in another order, each turned to start at another corner, and the vertices renumbered.
Shape permuted(const Shape& shape, std::uint64_t seed);
/// Every triangle with the opposite orientation.
Shape flipped(const Shape& shape);
/// Moved without a turn.
Shape moved(const Shape& shape, const Eigen::Vector3d& by);
/// As one part that is called `name`.
Shape named(Shape shape, const std::string& name);
/// A rotation, uniform over all of them.
Eigen::Matrix3d random_rotation(std::uint64_t seed);

/// Volume by the divergence theorem: right for closed, consistently oriented shapes, positive when outward
/// oriented.
double signed_volume(const Shape& shape);
double surface_area(const Shape& shape);
/// Does every directed edge of a part occur once, and its reverse once? Then each part is a closed, oriented
/// manifold along its edges.
bool is_closed(const Shape& shape);

}  // namespace stackabilization::solids
