#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "structure/symmetry/symmetry_verification.h"

namespace stackabilization::detail {

/// The surfaces of the parts of a shape, prepared for comparison under symmetries of the whole shape.
class PartSurfaces {
 public:
  /// Precondition: `validate(shape)`.
  PartSurfaces(const Shape& shape, const SymmetryOptions& options);
  ~PartSurfaces();
  PartSurfaces(const PartSurfaces&) = delete;
  PartSurfaces& operator=(const PartSurfaces&) = delete;

  const SymmetrySurface& whole() const { return whole_; }
  int count() const { return static_cast<int>(parts_.size()); }
  /// Returns the surface of a part, null for a part without area.
  const SymmetrySurface* part(int index) const;
  /// Returns the surfaces of all parts with area.
  std::vector<const SymmetrySurface*> with_area() const;

  /// Returns the candidates for `match` of part `a`, ascending: the parts whose centroids and widths are near
  /// those of its image. More than `max_matches` candidates are copies of each other in one place; the first
  /// ones are returned. `slack`: factor of the tolerance of places, not of sizes.
  std::vector<int> near_image(int a, const Symmetry& symmetry, double slack = 1) const;
  static constexpr std::size_t max_matches = 16;

  /// Returns the residual when `symmetry` (model units) maps part `a` to part `b`, as a fraction of the
  /// diagonal of the bounding box of the shape, and nothing otherwise. The parts match when
  ///
  /// * the centroids of their areas come within the tolerance of each other,
  /// * their root mean square widths along the principal axes agree to ten tolerances, or absolutely to a
  ///   tenth of the tolerance: a thin leg does not match a leg of half its thickness at any distance. So do
  ///   parts of which one lacks faces, if the sides of their minimal boxes agree. And
  /// * their surfaces agree in both directions, see `agreement`.
  ///
  /// Tolerances of distances are fractions of the whole shape. `slack`: factor of the tolerances of
  /// places and of surfaces, not of sizes.
  std::optional<double> match(int a, int b, const Symmetry& symmetry, double slack = 1) const;

  /// Part on which an image lies.
  struct Image {
    int part;         ///< row of Shape::part_names
    double residual;  ///< of all points of the image from the surface of the shape, fraction of the diagonal
  };
  /// Returns the part on which the image of part `a` lies to a tenth of the tolerance, up to a tenth of its
  /// area, for a symmetry of the whole shape. Nothing if there is no such part, or if the image does not
  /// agree with the surface of the shape. This also relates parts that do not match because their ends are
  /// cut off differently.
  std::optional<Image> image_of(int a, const Symmetry& symmetry) const;

 private:
  struct Centroids;
  bool same_size(int a, int b) const;
  bool is_near(const Eigen::Vector3d& centroid, int b, double tolerance) const;
  std::vector<double> distances(const SymmetrySurface& from, const SymmetrySurface& to,
                                const Eigen::Isometry3d& map) const;

  SymmetryOptions options_;
  SymmetrySurface whole_;
  std::vector<std::int32_t> part_of_;  ///< per triangle of the shape
  std::vector<std::optional<SymmetrySurface>> parts_;
  std::vector<Eigen::Vector3d> widths_;  ///< per part with area
  std::vector<Eigen::Vector3d> sides_;   ///< per part with area, of its minimal box
  std::unique_ptr<const Centroids> centroids_;
  double unit_;      ///< length that tolerances are fractions of, model units
  double diagonal_;  ///< diagonal of the axis-aligned box, model units
};

}  // namespace stackabilization::detail
