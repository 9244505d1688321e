#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "improvement/quality/surface_marks.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/improvement/quality.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// How the parts of an object lie to each other, and each to itself: the measures self_intersection,
/// collision, piercing and joints.
class PartContacts {
 public:
  /// Prepares what depends on the object at rest. `rest` must outlive this object.
  explicit PartContacts(const StructuredShape& rest);

  /// Takes the four measures, in their order.
  std::vector<QualityValue> measure(const Shape& now) const;

 private:
  using TrianglePair = std::pair<std::int32_t, std::int32_t>;
  /// Two parts that touch at rest.
  struct Pair {
    int first = 0, second = 0;
    double depth = 0;  ///< how deep one enters the other at rest, model units
  };
  /// A joint of two parts: the marks of each that are nearest to it, and the gap between the parts.
  struct Joint {
    std::array<int, 2> parts{};
    std::array<SurfaceMarks, 2> marks;
    double gap = 0;  ///< at rest, model units; 0 where one part enters the other
  };
  class Surfaces;

  void find_touching(const Surfaces& surfaces);
  void find_joints(const Surfaces& surfaces);
  std::vector<TrianglePair> intersections(const Shape& shape) const;
  /// Returns how deep marks lie inside of a part, model units.
  double depth(const Surfaces& surfaces, const Shape& shape, const SurfaceMarks& marks, int other) const;
  /// Returns how deep one of two parts enters the other, model units.
  double depth(const Surfaces& surfaces, const Shape& shape, int first, int second) const;
  double gap(const Surfaces& surfaces, const Shape& shape, const Joint& joint) const;
  SurfaceMarks marks_near(const Surfaces& surfaces, int part, const Eigen::Vector3d& point) const;
  double distance_at_rest(const TrianglePair& pair) const;
  bool touch(int first, int second) const;

  const StructuredShape& rest_;
  WeldedMesh welded_;                           ///< at rest
  std::vector<SurfaceMarks> marks_;             ///< per part
  std::vector<bool> solid_;                     ///< per part, whether it is a closed surface
  std::vector<TrianglePair> crossing_at_rest_;  ///< ascending
  std::vector<Pair> touching_;                  ///< ascending by parts
  std::vector<Joint> joints_;
};

}  // namespace stackabilization::detail
