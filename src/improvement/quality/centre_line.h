#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "improvement/quality/affine_fit.h"
#include "improvement/quality/surface_marks.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// Changes of an elongated part against rest.
struct CentreLineChange {
  double straightness = 0;  ///< distance of the line from its chord, of its length; straight lines only
  double bending = 0;  ///< largest change of turn at one or two stations against the affine image, degrees
  double section = 0;  ///< largest loss of roundness of a round section, of its width
  double profile = 0;  ///< unevenness of the change of the radii, of the radius
  double length = 1;   ///< length over that at rest; straight lines only
  double width = 1;    ///< smallest ratio of a radius to that at the same place at rest; straight lines only
  /// Ratios of the radii at both ends to those at rest, by the best affine function; straight lines only.
  std::array<double, 2> end_widths = {1, 1};
  /// Ends of the surface on the line, by the corners that are there at rest, so that sliding in between moves
  /// none of them; straight lines only.
  std::array<Eigen::Vector3d, 2> ends = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< from end to end, unit; straight lines only
};

/// Centre line and cross-sections of an elongated part, from pieces of its surface. Each piece belongs to the
/// two stations of the line between which it lies, weighted linearly and by area. The centre of a station is
/// the weighted mean of its pieces, its radius their mean distance from the line. Weights are balanced: at
/// rest, the centre lies on the curve of the primitive also where pieces are missing on one side, as behind
/// the handle of a cup, so that a cup that becomes a cone does not lean.
class CentreLine {
 public:
  static constexpr std::size_t default_pieces = 4000;  ///< of a part

  /// Returns the centre line of a part at rest along the curve of its primitive: the sections of a cylinder
  /// that is at least as long as its radius, or the longest axis of a cuboid if it is at least 3 times as
  /// long as wide. Nothing for other parts and where a station has too few pieces, of `max_pieces` in all.
  static std::optional<CentreLine> of(const Primitive& primitive, const Shape& rest,
                                      const std::vector<std::int32_t>& triangles,
                                      std::size_t max_pieces = default_pieces);

  /// Compares the part, now, with rest. `affine`: map of the part.
  CentreLineChange change(const Shape& now, const AffineMap& affine) const;
  /// Returns whether the line is straight at rest.
  bool is_straight() const { return straight_; }
  /// Returns the mean radius at rest, model units.
  double radius() const;
  /// Returns the direction from end to end at rest, unit.
  Eigen::Vector3d direction() const;
  /// Returns the ends at rest, as CentreLineChange::ends. Precondition: the line is straight.
  std::array<Eigen::Vector3d, 2> ends(const Shape& rest) const { return ends_on(rest, rest_); }

 private:
  struct Share {
    Eigen::Index mark;
    double weight;
  };
  struct Section {
    double radius = 0;     ///< model units
    double roundness = 1;  ///< square root of the ratio of the second moments across the line, at most 1
  };

  /// Multiplies the weights of a station by an affine function across the line (`along`, unit), so that the
  /// mean lies at `place`, but for the component along the line; or nearer to it, where weights would have to
  /// become 0.
  static void balance(std::vector<Share>& station, const Points& marks, const Eigen::Vector3d& place,
                      const Eigen::Vector3d& along);
  /// Finds the stations that lie mostly farther than a radius from the vertices shared with other parts.
  void find_own_stations(const Shape& rest, const std::vector<std::int32_t>& triangles, const Points& marks);
  Points centres(const Points& marks) const;
  std::array<Eigen::Vector3d, 2> ends_on(const Shape& shape, const Points& centres) const;
  std::vector<Section> sections(const Points& marks, const Points& centres) const;
  /// Returns the radius at rest at a place along the chord, from 0 to 1, interpolated linearly.
  double radius_at_rest(double share) const;

  SurfaceMarks marks_;
  std::vector<std::vector<Share>> stations_;  ///< the marks of every station
  bool closed_ = false, straight_ = false;
  double length_ = 0;       ///< at rest, model units
  double deviation_ = 0;    ///< distance from the chord at rest, of its length
  Points rest_;             ///< centres at rest
  Eigen::VectorXd shares_;  ///< places of the centres at rest along the chord, 0 to 1; straight lines only
  /// Places of the ends of the surface along the chord, just beyond 0 and 1; straight lines only.
  std::array<double, 2> end_shares_ = {0, 1};
  /// Corners near the ends of the surface; straight lines only.
  std::array<std::vector<Eigen::Index>, 2> end_corners_;
  std::vector<Section> sections_;
  /// Stations whose sections count: not those at a seam with another part of the surface, which may fill the
  /// corner there and follow that part.
  std::vector<Eigen::Index> own_stations_;
};

}  // namespace stackabilization::detail
