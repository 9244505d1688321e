#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "structure/symmetry/symmetry_verification.h"

namespace stackabilization::detail {

/// The parts of a shape, each a surface of its own, to be compared under symmetries of the whole.
class PartSurfaces {
 public:
  /// Precondition: `validate(shape)`.
  PartSurfaces(const Shape& shape, const SymmetryOptions& options);
  ~PartSurfaces();
  PartSurfaces(const PartSurfaces&) = delete;
  PartSurfaces& operator=(const PartSurfaces&) = delete;

  const SymmetrySurface& whole() const { return whole_; }
  int count() const { return static_cast<int>(parts_.size()); }
  /// Null for parts without area.
  const SymmetrySurface* part(int index) const;
  std::vector<const SymmetrySurface*> with_area() const;

  /// Rows of the parts that `match` has to be asked about for part `a`, ascending: those whose centroid and
  /// widths are near enough. Of more than `max_matches` such parts, copies of each other in one place, the
  /// first ones.
  std::vector<int> near_image(int a, const Symmetry& symmetry) const;
  static constexpr std::size_t max_matches = 16;

  /// Does `symmetry` (model units) take part `a` onto part `b`? If so, the residual as a fraction of the
  /// diagonal of the bounding box of the shape. It does when
  ///  * the centroids of their areas come within the tolerance of each other,
  ///  * their root mean square widths along their principal axes agree to ten tolerances or, absolutely,
  ///    to a tenth of the tolerance: a thin leg has no counterpart in one half as thick, however near, and
  ///  * their surfaces agree both ways, see `agreement`.
  /// Tolerances of place are fractions of the whole shape.
  std::optional<double> match(int a, int b, const Symmetry& symmetry) const;

 private:
  struct Centroids;
  bool same_size(int a, int b) const;
  bool is_near(const Eigen::Vector3d& centroid, int b) const;
  std::vector<double> distances(const SymmetrySurface& from, const SymmetrySurface& to,
                                const Eigen::Isometry3d& map) const;

  SymmetryOptions options_;
  SymmetrySurface whole_;
  std::vector<std::optional<SymmetrySurface>> parts_;
  std::vector<Eigen::Vector3d> widths_;  ///< per part with area
  std::unique_ptr<const Centroids> centroids_;
  double unit_;      ///< what tolerances are fractions of, model units
  double diagonal_;  ///< of the axis-aligned box, model units
};

}  // namespace stackabilization::detail
