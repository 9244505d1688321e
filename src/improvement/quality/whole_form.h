#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "improvement/quality/flat_faces.h"
#include "improvement/quality/part_forms.h"
#include "improvement/quality/surface_marks.h"
#include "mesh/surface_walk.h"
#include "stackabilization/improvement/quality.h"

namespace stackabilization::detail {

/// The form and the function of the whole object: the measures symmetry, seat, tilt, height and feet.
class WholeForm {
 public:
  /// Prepares what depends on the object at rest. `up`: unit vector against gravity.
  WholeForm(const StructuredShape& rest, const WeldedMesh& welded, const PartForms& parts,
            const Eigen::Vector3d& up);

  QualityValue symmetry(const Shape& now) const;  ///< the violation of symmetries
  /// Takes the measures seat, tilt, height and feet, in this order.
  std::vector<QualityValue> function(const Shape& now) const;

 private:
  /// Marks that a symmetry of the object maps onto its surface, and their images.
  struct SymmetricMarks {
    Eigen::Isometry3d map;
    std::vector<Eigen::Index> marks;  ///< rows of marks_
    SurfaceMarks images;
    std::vector<double> distances;  ///< at rest, model units
  };
  struct Seat {
    int part = 0;
    FlatFace face;
    double area = 0, height = 0;  ///< at rest: projected along `up`; of its centre over the ground
    double tilt = 0;              ///< at rest, radians
  };
  struct Foot {
    int part = 0;
    std::vector<Eigen::Index> vertices;
    double rise = 0;  ///< over the ground at rest, model units
  };

  void find_symmetric_marks(const StructuredShape& rest);
  void find_seats(const StructuredShape& rest, const PartForms& parts);
  void find_feet(const Shape& rest, const WeldedMesh& welded);
  double tilt_of(const FlatFace& face, const Shape& shape) const;
  double height_of(const FlatFace& face, const Shape& shape, double ground) const;
  double rise_of(const Foot& foot, const Shape& shape, double ground) const;

  Eigen::Vector3d up_;
  double diagonal_, height_;
  SurfaceWalk walk_;
  SurfaceMarks marks_;
  std::vector<SymmetricMarks> symmetric_;
  std::vector<Seat> seats_;
  std::vector<Foot> feet_;
};

}  // namespace stackabilization::detail
